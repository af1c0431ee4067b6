"""What a task file can say, as it is written: each class a section, each attribute a key.

Lengths are metres, angles degrees; boxes have full edge lengths; what is not said is left as it is.
"""

from dataclasses import dataclass, field
from typing import Literal

from sim.tasks.scene import Quaternion, Vector

Colour = str | tuple[float, ...]
"""The name of one of the file's colours, or red, green, blue and, where it lets light through, opacity."""


@dataclass(frozen=True)
class WrittenStart:
    """Pose of the grasping frame before each motion: its angle below the horizontal and about z, or a quaternion."""

    position: Vector
    pitch: float = 0.0
    yaw: float = 0.0
    quaternion: Quaternion | None = None


@dataclass(frozen=True)
class WrittenBase:
    """Where a robot's first link stands."""

    position: Vector
    yaw: float = 0.0


@dataclass(frozen=True)
class WrittenRegion:
    """Both ends of a box of places."""

    lower: Vector
    upper: Vector


@dataclass(frozen=True)
class WrittenTag:
    """A marker, by OpenCV's name of its dictionary."""

    id: int
    dictionary: str = "DICT_4X4_50"
    size: float = 0.06


@dataclass(frozen=True)
class WrittenObject:
    """An object; a cylinder's size is its diameter, twice, and its height."""

    name: str
    size: Vector
    region: WrittenRegion
    mass: float = 0.15
    shape: Literal["box", "cylinder"] = "box"
    tag: WrittenTag | None = None
    colour: Colour = (0.20, 0.45, 0.70)


@dataclass(frozen=True)
class WrittenBox:
    """A box, or a row of `count` equal ones, `spread` from the first to the last."""

    name: str
    centre: Vector
    size: Vector
    colour: Colour = (0.72, 0.55, 0.38)
    kind: Literal["solid", "panel", "detail"] = "solid"
    quaternion: Quaternion = (1.0, 0.0, 0.0, 0.0)
    variants: tuple[str, ...] = ()
    frame: str = ""
    count: int = 1
    spread: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class WrittenMesh:
    """A mesh, STL, beside the file."""

    name: str
    file: str
    position: Vector
    quaternion: Quaternion = (1.0, 0.0, 0.0, 0.0)
    scale: float = 1.0
    colour: Colour = (0.62, 0.66, 0.70)
    variants: tuple[str, ...] = ()
    frame: str = ""


@dataclass(frozen=True)
class WrittenCoordinate:
    """See `Coordinate`."""

    way: float | None = None
    line: float | None = None


@dataclass(frozen=True)
class WrittenPoint:
    """A way-point: x, y and z, or `object`, the way to it from the object's centre."""

    pitch: float
    x: float | WrittenCoordinate | None = None
    y: float | WrittenCoordinate | None = None
    z: float | WrittenCoordinate | None = None
    object: Vector | None = None


@dataclass(frozen=True)
class WrittenDetour:
    """See `Detour`."""

    around: tuple[float, float]
    room: float
    furthest: float
    rounding: float = 0.015


@dataclass(frozen=True)
class WrittenWay:
    """See `Way`."""

    points: tuple[WrittenPoint, ...]
    before: Vector = (0.0, 0.0, 0.0)
    detour: WrittenDetour | None = None


@dataclass(frozen=True)
class WrittenSuccess:
    """See `Success`; placed in a region, or on top of a box."""

    reached: Vector = (0.05, 0.065, 0.05)
    kicked_over: Vector = (0.10, 0.10, 0.10)
    tilt: float | None = None
    may_touch: tuple[str, ...] = ()
    force: float | None = None
    time: float | None = None
    grasped: bool = False
    lifted: float | None = None
    placed: WrittenRegion | None = None
    placed_on: str = ""


@dataclass(frozen=True)
class WrittenEye:
    """Where a bystander looks from, and at what."""

    position: Vector = (0.05, -0.95, 1.15)
    target: Vector = (0.62, 0.06, 0.62)


@dataclass(frozen=True)
class WrittenTask:
    """The whole file.

    Attributes:
        name: Of the task: what was learnt is bound to it.
        about: What it is, a line.
        variants: Two arrangements: motions are shown in the first, and the second is the changed one.
        start: See `WrittenStart`.
        objects: Of which `target`, or else the first, is the one that motions are relative to.
        training_places: Of the target's centre in the first demonstrations.
        target: An object's name.
        margin: How far beyond its region a target is allowed.
        success: See `WrittenSuccess`.
        base: Where robots stand, by their kind; "default" for all others.
        colours: Names for colours.
        frames: Where a frame's origin is in each variant: what moves as a whole.
        boxes: What stands around the robot.
        meshes: The same.
        corridors: Ways that somebody drew, by variant; without them a planner finds some.
        eye: See `WrittenEye`.
    """

    name: str
    variants: tuple[str, str]
    start: WrittenStart
    objects: tuple[WrittenObject, ...]
    training_places: tuple[Vector, ...]
    about: str = ""
    target: str = ""
    margin: float = 0.05
    success: WrittenSuccess = WrittenSuccess()
    base: dict[str, WrittenBase] = field(default_factory=dict)
    colours: dict[str, tuple[float, ...]] = field(default_factory=dict)
    frames: dict[str, dict[str, Vector]] = field(default_factory=dict)
    boxes: tuple[WrittenBox, ...] = ()
    meshes: tuple[WrittenMesh, ...] = ()
    corridors: dict[str, WrittenWay] = field(default_factory=dict)
    eye: WrittenEye = WrittenEye()

    @property
    def standing(self) -> tuple[WrittenBox | WrittenMesh, ...]:
        """All that stands around the robot."""
        return (*self.boxes, *self.meshes)
