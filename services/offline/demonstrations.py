"""The scripted operator teaches a scene offline: steers the arm to targets, with the stylus coupled to it (OffStyl)."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lfd.motion.demonstration import Demonstration
from lfd.motion.trajectory import Trajectory
from services.offline.rollout import rollout
from services.offline.steering import steered
from services.process.exceptions import CommandFailed
from services.robot.arm import Arm
from services.robot.assembly import simulated_arm
from sim.person.scatter import CAREFUL
from sim.pose import Pose
from sim.tasks import AnyScene, described

Array = NDArray[np.float64]

SEED = 0
TRIES = 5


def demonstrations(scene: AnyScene, places: Array | None = None, variant: str | None = None) -> list[Demonstration]:
    """A demonstration for each of some places of a scene's target.

    Args:
        scene: to teach in.
        places: of the target, shape (n, d) [m]; the scene's training positions by default.
        variant: of the scene; the one that its model is trained in by default.

    Raises:
        CommandFailed: no motion to some place succeeded.
        UnknownVariant: the scene has no such variant.
    """
    variant = variant or scene.variants[0]
    rng = np.random.default_rng(SEED)
    arm = simulated_arm(scene, variant, described(scene))
    return [
        demonstrate(arm, scene, place, rng, variant=variant)
        for place in (scene.training_positions if places is None else places)
    ]


def demonstrate(
    arm: Arm,
    scene: AnyScene,
    place: Array,
    rng: np.random.Generator,
    *,
    variant: str | None = None,
    start: Pose | None = None,
) -> Demonstration:
    """Steer the arm to the target, again where that fails; the motion as measured.

    Args:
        arm: in the scene.
        scene: whose corridor is steered through.
        place: of the target, shape (d,) [m].
        rng: of the person's unsteadiness.
        variant: of the scene; its first by default.
        start: of the motion; the scene's by default.

    Raises:
        CommandFailed: no try succeeded.
        StartImpossible: no motion can start there.
    """
    variant = variant or scene.variants[0]
    start = scene.start if start is None else start
    for _ in range(TRIES):
        trajectory = steered(
            scene.corridor(variant, place, start), rng, scene.freedom, scatter=CAREFUL * scene.unsteadiness
        )
        outcome = rollout(arm, trajectory, place, variant=variant, start=start)
        if outcome.verdict.success:
            # What the gripper was told, not what it measured: fingers that hold something would not press on it else.
            shown = replace(outcome.measured, opening=outcome.commanded.opening)
            return _demonstration(scene, place, shown)
    raise CommandFailed(f"no motion to a target at {np.round(place, 3).tolist()} succeeded in {TRIES} tries")


def _demonstration(scene: AnyScene, place: Array, motion: Trajectory) -> Demonstration:
    if scene.has_object:
        return Demonstration.reaching(motion, place)
    return Demonstration(motion, origin=np.zeros(3), condition=place)
