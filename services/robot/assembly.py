"""What stands in a scene, put together: backend, kinematics, criteria, starts."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from services.process.clock import Clock
from services.process.config import RobotSection
from services.process.exceptions import UnusableSetting
from services.robot.arm import Arm
from services.robot.backends.backend import Backend, Blocked
from services.robot.backends.hardware import Hardware, driver_of
from services.robot.backends.particle import ParticleBackend, ParticleKinematics
from services.robot.homing import Homing
from services.robot.mechanism import Mechanism
from services.robot.starts import StartImpossible, Starts
from services.robot.verdict import Criteria, ReachingCriteria
from services.robot.via_points import ViaPointCriteria
from sim.robots.description import RobotDescription
from sim.tasks import AnyScene
from sim.tasks.particle import ParticleScene
from sim.tasks.reaching import ReachingScene

Array = NDArray[np.float64]


def kinematics_of(scene: AnyScene, description: RobotDescription) -> Mechanism:
    """The kinematics of the robot that stands in a scene; those of an arm take half a second to make.

    Args:
        scene: of the robot.
        description: of the arm; a particle needs none.
    """
    match scene:
        case ReachingScene():
            # Imported here: the arm's packages take a second, and a particle needs none of them.
            from services.robot.kinematics import Kinematics  # noqa: PLC0415

            return Kinematics(description.urdf, scene.posture, scene.manipulator)
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
        StartImpossible: the arm cannot reach the scene's start, or would touch something there.
    """
    kinematics = kinematics or kinematics_of(scene, description)
    starts = Starts(kinematics, scene.start, scene.posture, self_distance_stop)
    backend, criteria = _stage(scene, variant, description)
    backend.connect()
    try:
        backend.reset(scene.training_positions[0], variant, starts.joints(scene.start))
    except Blocked as error:
        raise StartImpossible(scene.start.position, str(error)) from error
    return Arm(
        backend,
        kinematics,
        criteria,
        starts,
        velocity_scale=velocity_scale,
        self_distance_stop=self_distance_stop,
        wide_open=scene.manipulator.gripper.opening if isinstance(scene, ReachingScene) else 0.0,
        grips=isinstance(scene, ReachingScene) and scene.gripper,
    )


def hardware_arm(
    scene: AnyScene, section: RobotSection, description: RobotDescription, kinematics: Mechanism, clock: Clock
) -> Arm:
    """An arm of hardware, connected, that stands where it is, and is led to where motions start.

    Args:
        scene: that people have set up around it.
        section: of the configuration; its backend is not the simulated one.
        description: of the robot.
        kinematics: of the robot.
        clock: by which it is judged whether it is heard.

    Raises:
        UnusableSetting: there is no such hardware, or it cannot be that robot.
        RoomMissing: its maker's library is not installed.
        RobotNotAnswering: nobody answers at its address.
    """
    if not isinstance(scene, ReachingScene):
        raise UnusableSetting("[robot.backend] kind", f"no hardware stands in the scene {scene.name}: it is simulated")
    if not section.backend.host:
        raise UnusableSetting("[robot.backend] host", "nobody knows where the arm is reached: give --host")
    backend = Hardware(
        driver_of(section.backend.kind),
        section.backend.host,
        scene.manipulator,
        variant=section.variant or scene.variants[0],
        yaw=scene.stance.base.yaw if scene.stance.base is not None else 0.0,
        clock=clock,
    )
    starts = Starts(kinematics, scene.start, scene.posture, section.self_distance_stop)
    backend.connect()
    arm = Arm(
        backend,
        kinematics,
        _criteria(scene),
        starts,
        velocity_scale=section.velocity_scale,
        self_distance_stop=section.self_distance_stop,
        wide_open=scene.manipulator.gripper.opening,
        grips=scene.gripper,
    )
    touches = _touches(scene, description, kinematics, backend, section.self_distance_stop)
    arm.drive.homing = Homing(np.minimum(kinematics.velocity_limit, backend.limits.speed), touches)
    return arm


def _touches(
    scene: ReachingScene, description: RobotDescription, kinematics: Mechanism, backend: Backend, self_distance: float
) -> Callable[[Array], str]:
    """What an arm would touch, in words, were its joints somewhere: itself, or what the scene says stands around it."""
    from sim.world.physics import World  # noqa: PLC0415 (as above)

    world, place = World(scene, backend.variant, description), scene.training_positions[0]

    def touches(q: Array) -> str:
        if kinematics.self_distance(q) < self_distance:
            return "the robot would come too close to itself"
        world.reset(place, backend.variant, q)
        contacts = world.observe().contacts
        if not contacts:
            return ""
        return f"the robot's {contacts[0].robot_geom} would touch {contacts[0].environment_geom}"

    return touches


def _criteria(scene: ReachingScene) -> Criteria:
    return ReachingCriteria(scene.reached_radii, scene.kicked_thresholds, scene.tipping_angle, scene.success)


def _stage(scene: AnyScene, variant: str, description: RobotDescription) -> tuple[Backend, Criteria]:
    """What moves in a scene, and by what it is judged there."""
    match scene:
        case ReachingScene():
            from services.robot.backends.simulation import Simulation  # noqa: PLC0415 (as above)
            from sim.world.physics import World  # noqa: PLC0415 (as above)

            return Simulation(World(scene, variant, description)), _criteria(scene)
        case ParticleScene():
            return ParticleBackend(scene, variant), ViaPointCriteria(scene.via_x, scene.tolerance)
