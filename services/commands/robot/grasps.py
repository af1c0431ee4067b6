"""Where a robot can grasp: a map over two planes through its home posture."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lfd.motion.rotations import multiply
from services.robot.kinematics import Kinematics
from services.robot.mechanism import Unreachable
from sim.robots.description import prepare
from sim.robots.gripper import pitched_down
from sim.robots.robot import Base, Manipulator

Array = NDArray[np.float64]

CELL = 0.10
"""Between two places that are tried [m]."""

PITCH = np.radians(45.0)
"""At which a gripper is asked to point down [rad]."""

_SAMPLES = 6000


@dataclass(frozen=True, eq=False)
class Grasps:
    """What was found.

    Attributes:
        places: that the robot reaches in some orientation, in its first link's frame, shape (n, 3) [m].
        fine: where it can point forward and down, too, shape (n,).
    """

    places: Array
    fine: NDArray[np.bool_]

    @property
    def share(self) -> float:
        """Of the places that are fine."""
        return float(self.fine.mean()) if len(self.fine) else 0.0


def grasps(robot: Manipulator, cell: float = CELL) -> Grasps:
    """Try the places of two planes: upright, straight ahead, and level, at the height of the home posture.

    Args:
        robot: that reaches.
        cell: between two places [m].
    """
    home, rng = np.array(robot.home), np.random.default_rng(0)
    arm = Kinematics(prepare(robot=replace(robot, base=Base())).urdf, home, robot)
    postures = rng.uniform(arm.lower, arm.upper, (_SAMPLES, len(home)))
    cells = np.round(np.array([arm.forward(q).position for q in postures]) / cell).astype(int)
    level = int(np.round(arm.forward(home).position[2] / cell))
    seeds: dict[tuple[int, ...], Array] = {}
    for q, place in zip(postures, cells, strict=True):
        if place[1] == 0 or place[2] == level:
            seeds.setdefault(tuple(place.tolist()), q)
    places = cell * np.array(list(seeds), dtype=np.float64).reshape(-1, 3)
    fine = [_reached(arm, place, (home, q)) for place, q in zip(places, seeds.values(), strict=True)]
    return Grasps(places, np.array(fine, dtype=bool))


def _reached(arm: Kinematics, place: Array, seeds: tuple[Array, ...]) -> bool:
    # The arm turns about its own axis: a gripper that points away from it is as good as one that points along x.
    turn = np.arctan2(place[1], place[0])
    ahead = multiply(np.array([np.cos(turn / 2), 0.0, 0.0, np.sin(turn / 2)]), pitched_down(PITCH))
    try:
        arm.solve(place, ahead, seeds, np.random.default_rng(0))
    except Unreachable:
        return False
    return True
