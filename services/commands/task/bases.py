"""From where in front of a task a robot reaches all of it: its base is moved about, and everything is tried again."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from sim.planning.arm import PlanningArm
from sim.planning.ways import places
from sim.pose import Pose
from sim.robots.robot import Base
from sim.tasks.reaching import ReachingScene

Array = NDArray[np.float64]

STEP = 0.10
"""Between two places of the base that are tried [m]."""

_AROUND = 3  # steps to each side
_SEEDS = 3
_TURN_SLACK = 0.35  # [rad] that a grasp may be turned


@dataclass(frozen=True, eq=False)
class Placements:
    """What was found.

    Attributes:
        bases: that were tried, shape (n, 3), in the task's frame [m].
        shares: of the places that are reached from each, the start one of them, shape (n,).
    """

    bases: Array
    shares: Array

    @property
    def best(self) -> Array | None:
        """The middle of those from which everything is reached, of these the nearest one; None where there is none."""
        whole = self.bases[self.shares > 1.0 - 1e-9]
        if not len(whole):
            return None
        return np.asarray(whole[np.argmin(np.linalg.norm(whole - whole.mean(axis=0), axis=1))])


def placements(scene: ReachingScene) -> Placements:
    """Try places of the base round where it stands, level with it and turned as it is.

    Only whether the arm reaches counts: what a robot would touch on the way says `retouch task check` from there.

    Args:
        scene: the task, its robot in it.
    """
    base = scene.stance.base or Base()
    arm = PlanningArm(scene)
    route = scene.routes(scene.variants[0], scene.training_positions[0])[0]
    ends = [route.positions[number] - scene.training_positions[0] for number in (-1, -3)]
    wanted = [scene.start]
    wanted += [Pose(place + end, route.orientations[-1]) for place in places(scene) for end in ends]
    steps = STEP * np.arange(-_AROUND, _AROUND + 1)
    tried = [np.array([x, y, 0.0]) for x, y in product(steps.tolist(), steps.tolist())]
    shares = [_share(arm, wanted, moved) for moved in tried]
    return Placements(np.array(base.position) + np.array(tried), np.array(shares))


def _share(arm: PlanningArm, wanted: list[Pose], moved: Array) -> float:
    """Of the poses, those that are reached when the base is moved: as those are that are moved the other way."""
    reached = 0
    for pose in wanted:
        q = arm.solve(Pose(pose.position - moved, pose.orientation), arm.seeds(_SEEDS), _TURN_SLACK)
        reached += q is not None
    return reached / len(wanted)
