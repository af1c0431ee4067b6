"""A robot of a person's own: a TOML file beside its description, read into the value that every robot is."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

import msgspec

from services.process import cameras
from services.process.cameras import CameraName
from services.process.exceptions import ConfigurationError
from services.process.section import Positive, Section
from services.process.written import read
from sim.region import Region
from sim.robots.gripper import Block, Finger, Gripper, Mount, two_fingers
from sim.robots.robot import (
    FIELD_OF_VIEW,
    HEAD_CAMERA,
    WRIST_CAMERA,
    Base,
    Camera,
    HeldJoint,
    Joint,
    Manipulator,
    Source,
    Stance,
    mast_camera,
    wrist_camera,
)

WHAT = "robot file"
LARGEST_REACH = 2.0
"""Where a file does not say how far the robot reaches, nothing within so far of its base is refused [m]."""

Vector = tuple[float, float, float]
Name = Annotated[str, msgspec.Meta(pattern="^[a-z0-9][a-z0-9_-]{0,30}$")]


class MountSection(Section, frozen=True):
    """Where something is fixed; see `Mount`."""

    link: str
    position: Vector = (0.0, 0.0, 0.0)
    rpy: Vector = (0.0, 0.0, 0.0)


class JointSection(Section, frozen=True):
    """A joint that is commanded; see `Joint`. What is not said is what suits an arm of a person's size."""

    name: str
    lower: float | None = None
    upper: float | None = None
    speed: Positive | None = None
    acceleration: Positive = 5.0
    jerk: Positive = 50.0
    stiffness: Positive = 1000.0
    damping: Positive = 60.0
    armature: Annotated[float, msgspec.Meta(ge=0.0)] = 0.1
    lag: Positive = 0.01


class HeldSection(Section, frozen=True):
    """A joint that is held; see `HeldJoint`."""

    name: str
    position: float = 0.0
    stiffness: Positive = 100.0
    damping: Positive = 4.0
    armature: Annotated[float, msgspec.Meta(ge=0.0)] = 0.05


class BlockSection(Section, frozen=True):
    """A box of the gripper: its centre and full edge lengths, in the gripper's frame [m]."""

    centre: Vector
    size: Vector


class FingerSection(Section, frozen=True):
    """A joint that opens and closes the gripper; see `Finger`."""

    joint: str
    closed: float
    wide: float
    effort: Positive = 20.0
    armature: Annotated[float, msgspec.Meta(ge=0.0)] = 0.1


class GripperSection(Section, frozen=True):
    """The gripper's frame, x forward and the fingers opening along y, and what is there.

    Attributes:
        link: of the description.
        position: of the gripper's frame in the link's [m].
        rpy: the same [rad].
        two_fingers: an arm without a gripper gets one of two fingers.
        grasp_distance: of the description's own gripper, from its frame to where it grasps, along x [m].
        opening: of it [m].
        camera: of the wrist camera, in its frame [m].
        blocks: how it fills space.
        fingers: of the description's own gripper; without any it is rigid, wide open.
        speed: of its opening [m/s].
        jaw: link that does not move, which the finger closes upon.
    """

    link: str
    position: Vector = (0.0, 0.0, 0.0)
    rpy: Vector = (0.0, 0.0, 0.0)
    two_fingers: bool = False
    grasp_distance: Annotated[float, msgspec.Meta(ge=0.0)] = 0.1
    opening: Positive = 0.08
    camera: Vector = (0.0, 0.0, -0.06)
    blocks: tuple[BlockSection, ...] = ()
    fingers: tuple[FingerSection, ...] = ()
    speed: Positive = 0.1
    jaw: str = ""


class CameraSection(MountSection, frozen=True):
    """A camera, x right, y down, z forward; its vertical field of view [deg]."""

    fovy: Annotated[float, msgspec.Meta(gt=1.0, lt=170.0)] | None = None


class BaseSection(Section, frozen=True):
    """Where the first link stands in a scene [m, rad]."""

    position: Vector = (0.0, 0.0, 0.0)
    yaw: float = 0.0


class StanceSection(Section, frozen=True):
    """How it stands in one scene; see `Stance`."""

    posture: tuple[float, ...] = ()
    base: BaseSection | None = None


class ReachSection(Section, frozen=True):
    """Box around all that it reaches, in its first link's frame [m]."""

    lower: Vector
    upper: Vector


class RobotFile(Section, frozen=True):
    """All that a file can say; see `Manipulator`.

    Attributes:
        cameras: by their names; a head camera is on a mast and a wrist camera on the gripper's back where it says no
            other.
    """

    name: Name
    description: str
    joints: Annotated[tuple[JointSection, ...], msgspec.Meta(min_length=1, max_length=16)]
    home: tuple[float, ...]
    gripper: GripperSection
    held: tuple[HeldSection, ...] = ()
    base: BaseSection = BaseSection()
    reach: ReachSection | None = None
    turn_slack: Annotated[float, msgspec.Meta(ge=0.0, le=3.2)] = 0.0
    cameras: dict[CameraName, CameraSection] = msgspec.field(default_factory=dict)
    stances: dict[str, StanceSection] = msgspec.field(default_factory=dict)
    limbs: tuple[str, ...] = ()
    trunk: tuple[str, ...] = ()


def load_robot(path: Path) -> Manipulator:
    """The robot that a file describes.

    Raises:
        ConfigurationError: it is not there, cannot be parsed, or has a wrong key, type or value; says which.
    """
    said = read_robot(path)
    postures = {"home": said.home}
    postures |= {f"[stances.{name}] posture": one.posture for name, one in said.stances.items() if one.posture}
    for where, posture in postures.items():
        if len(posture) != len(said.joints):
            raise ConfigurationError(path, f"{where}: {len(posture)} positions for {len(said.joints)} joints", WHAT)
    return robot_of(said, path)


def read_robot(path: Path) -> RobotFile:
    """What a file says; raises as `load_robot`."""
    return read(path, RobotFile, WHAT)


def robot_of(said: RobotFile, path: Path) -> Manipulator:
    """What a file says, as the value that every robot is.

    Args:
        said: in the file.
        path: of the file, beside which its description lies.
    """
    far = (LARGEST_REACH,) * 3
    reach = said.reach or ReachSection((-LARGEST_REACH,) * 3, far)
    return Manipulator(
        kind=said.name,
        reach=Region(reach.lower, reach.upper),
        source=Source(str((path.parent / said.description).absolute()), package=""),
        joints=tuple(Joint(**msgspec.structs.asdict(joint)) for joint in said.joints),
        held=tuple(HeldJoint(**msgspec.structs.asdict(joint)) for joint in said.held),
        gripper=_gripper(said.gripper),
        home=said.home,
        cameras=_cameras(said.cameras),
        base=_base(said.base),
        stances={name: _stance(stance, said.home) for name, stance in said.stances.items()},
        turn_slack=said.turn_slack,
        limbs=said.limbs,
        trunk=said.trunk,
    )


def _gripper(said: GripperSection) -> Gripper:
    mount = Mount(said.link, said.position, said.rpy)
    if said.two_fingers:
        return two_fingers(mount)
    blocks = tuple(Block(f"block_{n}", block.centre, block.size) for n, block in enumerate(said.blocks))
    return Gripper(
        mount,
        blocks,
        said.grasp_distance,
        said.opening,
        said.camera,
        fingers=tuple(Finger(**msgspec.structs.asdict(finger)) for finger in said.fingers),
        speed=said.speed,
        jaw=said.jaw,
    )


def _cameras(said: Mapping[str, CameraSection]) -> tuple[Camera, ...]:
    usual = {HEAD_CAMERA: mast_camera(), WRIST_CAMERA: wrist_camera()}
    return tuple({**usual, **{name: _camera(name, camera) for name, camera in said.items()}}.values())


def _camera(name: str, said: CameraSection) -> Camera:
    fovy = said.fovy or FIELD_OF_VIEW.get(name, cameras.FIELD_OF_VIEW)
    return Camera(name, Mount(said.link, said.position, said.rpy), fovy)


def _base(said: BaseSection) -> Base:
    return Base(said.position, said.yaw)


def _stance(said: StanceSection, home: tuple[float, ...]) -> Stance:
    return Stance(said.posture or home, base=None if said.base is None else _base(said.base))
