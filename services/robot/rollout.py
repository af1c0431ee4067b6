"""Episodes without bus and clock, as fast as they go: to give first demonstrations, and to map success."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lfd.trajectory import Trajectory
from services.robot.arm import Arm, Tick
from services.robot.backend import CONTROL_PERIOD, Backend
from services.robot.correction import UNCORRECTED, Correction
from services.robot.episode import EpisodeOutcome
from services.robot.execution import look_ahead
from services.robot.kinematics import Kinematics
from services.robot.mechanism import Mechanism
from services.robot.particle import ParticleBackend, ParticleKinematics
from services.robot.simulation import Simulation
from services.robot.starts import Starts
from services.robot.verdict import Criteria, ReachingCriteria
from services.robot.via_points import ViaPointCriteria
from sim.description import RobotDescription
from sim.pose import Pose
from sim.scenes import AnyScene
from sim.scenes.particle import ParticleScene
from sim.scenes.scene import ReachingScene
from sim.world import World

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class RolloutView:
    """What an operator, or a script in its place, goes by.

    Attributes:
        time: since the rollout began [s].
        progress: of the prediction, from 0 to 1.
        nominal: what the prediction alone says now.
        correction: as it is applied now.
        tick: the last control period.
    """

    time: float
    progress: float
    nominal: Pose
    correction: Correction
    tick: Tick


Operator = Callable[[RolloutView], Correction]
"""From what is seen to the correction that is asked for."""


def kinematics_of(scene: AnyScene, description: RobotDescription) -> Mechanism:
    """The kinematics of the robot that stands in a scene; those of an arm take half a second to make.

    Args:
        scene: of the robot.
        description: of the arm; a particle needs none.
    """
    match scene:
        case ReachingScene():
            return Kinematics(description.urdf, scene.posture)
        case ParticleScene():
            return ParticleKinematics(scene.freedom.axes)


def simulated_arm(
    scene: AnyScene,
    variant: str,
    description: RobotDescription,
    *,
    kinematics: Mechanism | None = None,
    velocity_scale: float = 0.5,
    self_distance_stop: float = 0.005,
) -> Arm:
    """An arm in a simulated scene, at the scene's start; it takes about a second to make and is used again.

    Args:
        scene: what it stands in.
        variant: of the scene.
        description: of the arm; a particle needs none.
        kinematics: of the robot; made by default.
        velocity_scale: share of the joints' speed limits that may be used.
        self_distance_stop: distance between the robot's parts at which it stops [m].

    Raises:
        UnknownVariant: the scene has no such variant.
        StartImpossible: the arm cannot reach the scene's start.
    """
    kinematics = kinematics or kinematics_of(scene, description)
    starts = Starts(kinematics, scene.start, scene.posture, self_distance_stop)
    backend, criteria = _stage(scene, variant, description)
    backend.reset(scene.training_positions[0], variant, starts.joints(scene.start))
    return Arm(
        backend,
        kinematics,
        criteria,
        starts,
        velocity_scale=velocity_scale,
        self_distance_stop=self_distance_stop,
    )


def _stage(scene: AnyScene, variant: str, description: RobotDescription) -> tuple[Backend, Criteria]:
    """What moves in a scene, and by what it is judged there."""
    match scene:
        case ReachingScene():
            criteria = ReachingCriteria(scene.reached_radii, scene.kicked_thresholds)
            return Simulation(World(scene, variant, description)), criteria
        case ParticleScene():
            return ParticleBackend(scene, variant), ViaPointCriteria(scene.via_x, scene.tolerance)


def rollout(
    arm: Arm,
    prediction: Trajectory,
    place: Array,
    *,
    variant: str | None = None,
    start: Pose | None = None,
    operator: Operator | None = None,
    after: float | None = None,
    to_collision: bool = False,
) -> EpisodeOutcome:
    """Reset the arm and execute a prediction to the end.

    Args:
        arm: on a simulated backend, as `simulated_arm` makes it.
        prediction: in the base frame.
        place: of the target: centre of the object, shape (3,) [m], or y of the via-points, shape (2,) [m].
        variant: of the scene; as it is by default.
        start: of the grasping frame; as it was by default.
        operator: who corrects it; nobody by default.
        after: look-ahead of the correction [s]; one way-point interval by default, 0 moves the current way-point.
        to_collision: end at the first touch, for whoever wants to know no more.

    Raises:
        StartImpossible: no motion can start there.
    """
    arm.reset(place, arm.variant if variant is None else variant, start)
    arm.begin(prediction, look_ahead(prediction) if after is None else after)
    tick = arm.tick(UNCORRECTED)
    time = CONTROL_PERIOD
    while tick.outcome is None:
        wanted = UNCORRECTED
        if operator is not None and arm.episode is not None:
            execution = arm.episode.execution
            wanted = operator(RolloutView(time, execution.progress, execution.nominal, execution.correction, tick))
        if to_collision and tick.verdict.collision is not None:
            arm.finish("it collided")
        tick = arm.tick(wanted)
        time += CONTROL_PERIOD
    return tick.outcome
