"""The scripted operator teaches a scene offline: steers the arm to objects, with the stylus coupled to it (OffStyl)."""

import numpy as np
from numpy.typing import NDArray

from lfd.demonstration import Demonstration
from lfd.resampling import from_samples
from lfd.trajectory import Trajectory
from services.exceptions import CommandFailed
from services.robot.arm import Arm
from services.robot.rollout import rollout, simulated_arm
from sim.description import prepare
from sim.pose import Pose
from sim.scenes.scene import Corridor, Scene
from sim.steering import steer

Array = NDArray[np.float64]

SEED = 0
DURATION_S = 10.0
"""Of a demonstration: the thesis' time of an autonomous execution."""

POINTS = 75
TRIES = 5


def lesson(scene: Scene) -> list[Demonstration]:
    """A demonstration for each of a scene's training positions, in its first variant.

    Raises:
        CommandFailed: no motion to some object succeeded.
    """
    rng = np.random.default_rng(SEED)
    arm = simulated_arm(scene, scene.variants[0], prepare())
    return [demonstrate(arm, scene, position, rng) for position in scene.training_positions]


def demonstrate(
    arm: Arm, scene: Scene, position: Array, rng: np.random.Generator, start: Pose | None = None
) -> Demonstration:
    """Steer the arm to an object, again where that fails; the motion as measured.

    Args:
        arm: in the scene.
        scene: whose first variant's corridor is steered through.
        position: of the object, shape (3,) [m].
        rng: of the person's unsteadiness.
        start: of the motion; the scene's by default.

    Raises:
        CommandFailed: no try succeeded.
        StartImpossible: no motion can start there.
    """
    start = scene.start if start is None else start
    for _ in range(TRIES):
        trajectory = steered(scene.corridor(scene.variants[0], position, start), rng)
        outcome = rollout(arm, trajectory, position, variant=scene.variants[0], start=start)
        if outcome.verdict.success:
            return Demonstration.reaching(outcome.measured, position)
    raise CommandFailed(f"no motion to an object at {np.round(position, 3).tolist()} succeeded in {TRIES} tries")


def steered(corridor: Corridor, rng: np.random.Generator | None = None) -> Trajectory:
    """A person's motion through a corridor; with a steady hand where there is no randomness."""
    way = steer(corridor, rng)
    times = np.linspace(0.0, DURATION_S, len(way.positions))
    return from_samples(times, way.positions, way.orientations, POINTS)
