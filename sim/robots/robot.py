"""What a robot is: a value that says everything of it that the rest of the project needs to know.

Whoever brings a robot writes one such value, as a file in `sim/robots/models/`, or as a TOML file beside a description.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from sim.exceptions import OutOfReach
from sim.region import Array, Region
from sim.robots.gripper import WRIST_CAMERA_FRAME, Gripper, Mount, Vector

HEAD_CAMERA, WRIST_CAMERA = USUAL_CAMERAS = "head", "wrist"
"""The names of what robots usually see with."""
FIELD_OF_VIEW = {HEAD_CAMERA: 36.0, WRIST_CAMERA: 60.0}
"""Of the cameras whose robot says no other [deg], vertical."""

ELSEWHERE = ""
"""In a robot's stances, how it stands where it has no other."""

PACKAGE = "example-robot-data"
"""Where the robots that ship have their descriptions from."""


@dataclass(frozen=True)
class Joint:
    """A joint that is commanded; rad, or m where it slides.

    Attributes:
        name: In the description.
        stiffness: Of its servo in the simulator [N m/rad].
        damping: Of its servo [N m s/rad].
        armature: Inertia of motor and gear, as the joint feels it [kg m^2].
        lag: A reference that is further away is not followed at once: how hard a blocked arm pushes [rad].
        acceleration: That it may have at most [rad/s^2].
        jerk: The same [rad/s^3].
        lower: Least position; the description's where it is None [rad].
        upper: Greatest position; the same [rad].
        speed: Greatest speed; the same [rad/s].
    """

    name: str
    stiffness: float
    damping: float
    armature: float
    lag: float
    acceleration: float
    jerk: float
    lower: float | None = None
    upper: float | None = None
    speed: float | None = None


@dataclass(frozen=True)
class HeldJoint:
    """A joint that moves and is not commanded: a head's. Its servo holds it.

    Attributes:
        name: In the description.
        position: Where it is held; a stance may say another [rad, m].
        stiffness: See `Joint`.
        damping: See `Joint`.
        armature: See `Joint`.
    """

    name: str
    position: float = 0.0
    stiffness: float = 100.0
    damping: float = 4.0
    armature: float = 0.05


@dataclass(frozen=True)
class Camera:
    """A camera, whose optical axes are x right, y down, z forward.

    Attributes:
        name: Of the camera.
        mount: To what it is fixed.
        fovy: Vertical field of view [deg].
    """

    name: str
    mount: Mount
    fovy: float


@dataclass(frozen=True)
class Base:
    """Where a robot's first link stands in the frame that a scene is described in.

    Attributes:
        position: [m].
        yaw: [rad].
    """

    position: Vector = (0.0, 0.0, 0.0)
    yaw: float = 0.0

    @property
    def is_origin(self) -> bool:
        """The robot stands where the scene's frame is."""
        return self == Base()


@dataclass(frozen=True)
class Stance:
    """How a robot stands in a scene.

    Attributes:
        posture: Joint positions that a search for the scene's start begins with [rad, m].
        held: Positions of the held joints, in their order; as the robot says where it is empty [rad, m].
        base: Where it stands; as the robot says where it is None.
    """

    posture: tuple[float, ...]
    held: tuple[float, ...] = ()
    base: Base | None = None


@dataclass(frozen=True)
class Source:
    """Where a description lies.

    Attributes:
        file: In the folder of the package; or the path of a person's own file.
        package: That is installed; empty for a person's own file.
    """

    file: str
    package: str = PACKAGE


@dataclass(frozen=True)
class Robot:
    """A kind of robot; what was learnt with one is good for that kind only.

    Attributes:
        kind: Its name, "tiago" for one.
        reach: Box around all positions that its grasping frame can take, in the frame of its first link [m]. Not all in
            it can be taken.
    """

    kind: str
    reach: Region

    def check(self, what: str, positions: Array) -> None:
        """Let pass positions that the robot may be able to take.

        Args:
            what: They are called in an error.
            positions: Shape (n, 3), base frame [m].

        Raises:
            OutOfReach: One of them lies outside the box.
        """
        low, high = np.array(self.reach.lower), np.array(self.reach.upper)
        outside = np.flatnonzero(~np.all((positions >= low) & (positions <= high), axis=1))
        if outside.size:
            where = f"the reach of {self.kind}"
            raise OutOfReach(what, positions[outside[0]].tolist(), where, self.reach.lower, self.reach.upper)


@dataclass(frozen=True)
class Manipulator(Robot):
    """An arm, with whatever carries it.

    Attributes:
        source: Of its description, URDF or MJCF.
        joints: That are commanded, from the base to the gripper.
        held: That move and are not commanded.
        gripper: At its end; it says where the grasping frame is.
        home: Positions of the joints where nothing else is said; away from their limits and from the robot itself.
        cameras: What it sees with.
        base: Where it stands in scenes that it has no stance for.
        stances: How it stands in a scene, by the scene's name; `ELSEWHERE` in all others.
        turn_slack: By how much it may leave an orientation that it is asked for [rad]: nothing for an arm that can have
            any, much for one of five joints, whose orientation follows from the position.
        limbs: Shapes that can meet the trunk, by their links, or by link and number, "link_0"; by default all those
            that are carried by the fourth joint, or by the third of less than six.
        trunk: Shapes that the limbs can meet; by default all those before the second joint.
    """

    source: Source
    joints: tuple[Joint, ...]
    gripper: Gripper
    home: tuple[float, ...]
    cameras: tuple[Camera, ...]
    held: tuple[HeldJoint, ...] = ()
    base: Base = Base()
    stances: Mapping[str, Stance] = field(default_factory=dict, hash=False)
    turn_slack: float = 0.0
    limbs: tuple[str, ...] = ()
    trunk: tuple[str, ...] = ()

    @cached_property
    def joint_names(self) -> tuple[str, ...]:
        """Of every joint vector, in order."""
        return tuple(joint.name for joint in self.joints)

    @cached_property
    def held_names(self) -> tuple[str, ...]:
        """Of the joints that are held."""
        return tuple(joint.name for joint in self.held)

    @cached_property
    def moving_names(self) -> tuple[str, ...]:
        """Of all joints that are not rigid: commanded, held, and the gripper's."""
        return (*self.joint_names, *self.held_names, *self.gripper.finger_names)

    @property
    def servos(self) -> tuple[Joint | HeldJoint, ...]:
        """The arm's joints that a servo moves, those that are commanded first."""
        return (*self.joints, *self.held)

    def positions(self, stance: Stance) -> dict[str, float]:
        """Return where all joints are that are not rigid, the gripper wide open, by their names [rad, m].

        Args:
            stance: Everything said of it, see `stance`.
        """
        arm = zip((*self.joint_names, *self.held_names), (*stance.posture, *stance.held), strict=True)
        return dict(arm) | self.gripper.positions(self.gripper.opening)

    def stance(self, scene: str) -> Stance:
        """Return how it stands in a scene, everything said.

        Args:
            scene: The scene's name.
        """
        own = self.stances.get(scene) or self.stances.get(ELSEWHERE) or Stance(self.home)
        held = own.held or tuple(joint.position for joint in self.held)
        return Stance(own.posture, held, own.base or self.base)

    def standing(self, base: Base) -> Robot:
        """Return the robot as it is seen from a scene in which its base stands somewhere: with its reach there.

        Args:
            base: Where.
        """
        if base.is_origin:
            return self
        (x0, y0, z0), (x1, y1, z1) = self.reach.lower, self.reach.upper
        cosine, sine = math.cos(base.yaw), math.sin(base.yaw)
        flat = [(cosine * x - sine * y, sine * x + cosine * y) for x in (x0, x1) for y in (y0, y1)]
        placed = np.array([(*corner, z) for corner in flat for z in (z0, z1)]) + base.position
        return Robot(self.kind, Region(tuple(placed.min(axis=0).tolist()), tuple(placed.max(axis=0).tolist())))


def wrist_camera() -> Camera:
    """The camera on a gripper's back, at the frame that every gripper has for it."""
    return Camera(WRIST_CAMERA, Mount(WRIST_CAMERA_FRAME), FIELD_OF_VIEW[WRIST_CAMERA])


def mast_camera() -> Camera:
    """A camera in a head's place, for a robot without one: on a mast, looking down at what is before the arm."""
    tilt = math.radians(48.0)
    mount = Mount("", (0.245, 0.02, 1.28), (-math.pi / 2 - tilt, 0.0, -math.pi / 2))
    return Camera(HEAD_CAMERA, mount, FIELD_OF_VIEW[HEAD_CAMERA])


PARTICLE = Robot("particle", Region((-0.1, -0.5, -0.1), (0.6, 0.5, 0.1)))
"""The point of the thesis' two-dimensional example, and room around its board."""
