"""What a scene is: where motions start, what stands around the robot, and where their target can be.

All positions are in the robot's base frame: x forward, y left, z up.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from enum import Enum
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from sim.exceptions import OutOfReach, UnknownVariant, WrongPlace
from sim.pose import Pose
from sim.region import Region
from sim.robots.robot import Robot

Array = NDArray[np.float64]
Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]  # scalar first

NO_ROTATION: Quaternion = (1.0, 0.0, 0.0, 0.0)

_JOINED = 0.5  # share of the way-points after which a corridor from any start is the same


class Group(Enum):
    """What a box is there for."""

    SOLID = "solid"  # drawn, and collides
    PANEL = "panel"  # drawn translucent, and collides: the envelope of what is too fine to collide with
    DETAIL = "detail"  # drawn only


@dataclass(frozen=True)
class Box:
    """One box of the environment.

    Attributes:
        name: Unique in its scene and variant.
        centre: [m].
        half_sizes: Half edge lengths [m].
        quaternion: Orientation, scalar first.
        rgba: Colour, each in [0, 1].
        group: What it is there for.
    """

    name: str
    centre: Vector
    half_sizes: Vector
    rgba: tuple[float, float, float, float]
    group: Group = Group.SOLID
    quaternion: Quaternion = NO_ROTATION


class Corridor(NamedTuple):
    """Way-points that a person would steer the grasping frame through.

    Attributes:
        positions: Shape (k, 3) [m].
        orientations: Scalar first, shape (k, 4).
        openings: Of the gripper when it leaves each of them, shape (k,) [m]; None where it takes no part. Where it
            changes the grasping frame stands meanwhile.
    """

    positions: Array
    orientations: Array
    openings: Array | None = None


class Freedom(NamedTuple):
    """What a person decides of a robot's motion.

    Attributes:
        axes: Base axes along which they can move it off its way, 1 or 0 each.
        tempo: They decide when it is where; else a corridor's way-points are passed at equal steps of time.
        targets: Shares of a corridor, beside its end, at which they aim at something: of its length, or of its time
            where the tempo is not theirs.
    """

    axes: Vector = (1.0, 1.0, 1.0)
    tempo: bool = True
    targets: tuple[float, ...] = ()


class Eye(NamedTuple):
    """Where a bystander looks from, and at what [m]; by default, at an arm and at what is before it."""

    position: Vector = (0.05, -0.95, 1.15)
    target: Vector = (0.62, 0.06, 0.62)


@dataclass(frozen=True, eq=False, kw_only=True)
class Scene(ABC):
    """A place where a motion is learnt, with one change that breaks it: what all kinds of scenes have.

    A place says where the target is that a motion depends on; each kind of scene says of what.

    Attributes:
        name: Of the scene.
        variants: The first is the one that demonstrations were given in, the second the changed one.
        start: Pose of the grasping frame before each motion.
        region: Of the places that are drawn.
        margin: How far beyond the region a place is allowed, on each axis [m].
        training_positions: Places of the initial demonstrations, shape (n, d) [m].
        freedom: Of a person who moves the robot.
        eye: From where one sees all of it.
        has_object: A place is where an object stands, and motions are relative to it; else it is a condition by itself.
    """

    has_object: ClassVar[bool]

    name: str
    variants: tuple[str, str]
    start: Pose
    region: Region
    margin: float = 0.05
    training_positions: Array
    freedom: Freedom = field(default_factory=Freedom)
    eye: Eye = field(default_factory=Eye)

    @property
    def reference(self) -> str:
        """By what `sim.tasks.scene` finds it again, in another process, too."""
        return self.name

    @property
    def wide_open(self) -> float:
        """How far the gripper opens where it takes part [m]; 0 where it takes none."""
        return 0.0

    @property
    def unsteadiness(self) -> float:
        """By how many times as much as usual a person's motions scatter who leads this robot."""
        return 1.0

    @property
    def turn_slack(self) -> float:
        """By how much the robot may leave an orientation that it is asked for [rad]."""
        return 0.0

    @property
    @abstractmethod
    def robot(self) -> Robot:
        """Return what moves in it, as it stands there."""

    @property
    @abstractmethod
    def posture(self) -> Array:
        """Return joint positions near the start, in the order of the robot's joints, shape (m,)."""

    @abstractmethod
    def layout(self, variant: str) -> tuple[Box, ...]:
        """Return the boxes of a variant that there is; call `boxes` instead."""

    @abstractmethod
    def routes(self, variant: str, place: Array) -> tuple[Corridor, ...]:
        """Return the ways of a variant to a place, both of which there are; call `corridors` instead."""

    def boxes(self, variant: str) -> tuple[Box, ...]:
        """Return what stands around the robot.

        Args:
            variant: One of `variants`.

        Raises:
            UnknownVariant: There is no such variant.
        """
        self.check(variant)
        return self.layout(variant)

    def shown(self, variant: str) -> tuple[Box, ...]:
        """Return the boxes, and as boxes what else stands there, for whoever draws nothing else.

        Raises:
            UnknownVariant: There is no such variant.
        """
        return self.boxes(variant)

    def corridors(self, variant: str, place: Array, start: Pose | None = None) -> tuple[Corridor, ...]:
        """Return the ways from the start to the target that are clear of the environment, the shortest first.

        The corridors of the two variants pair way-point by way-point, with the same orientations:
        their difference is the correction that an operator has to give.

        Args:
            variant: One of `variants`.
            place: Of the target, shape (d,) [m].
            start: Pose of the grasping frame that it leads from; the scene's own by default.

        Raises:
            UnknownVariant: There is no such variant.
            WrongPlace: It has another number of dimensions.
        """
        self.check(variant)
        if len(place) != len(self.region.lower):
            raise WrongPlace(self.name, len(place), len(self.region.lower))
        routes = self.routes(variant, place)
        if start is not None:
            routes = tuple(_joined(route, start) for route in routes)
        return tuple(self.completed(route, place) for route in routes)

    def completed(self, route: Corridor, place: Array) -> Corridor:
        """Return a route that leads to the target, and on from there where the task asks for more.

        Args:
            route: One of the `routes`.
            place: Of the target, shape (d,) [m].
        """
        del place
        return route

    def corridor(self, variant: str, place: Array, start: Pose | None = None) -> Corridor:
        """Return the shortest of the `corridors`."""
        return self.corridors(variant, place, start)[0]

    @property
    def object_size(self) -> Vector:
        """Full edge lengths of the object [m]; nought where there is none."""
        return (0.0, 0.0, 0.0)

    @property
    @abstractmethod
    def tolerances(self) -> Vector:
        """Half axes of the ellipsoid in which a target counts as reached [m]."""

    @property
    def point(self) -> float | None:
        """Radius of a robot that is a point to whoever draws it [m]; None for one of links."""
        return None

    @property
    def kick_limits(self) -> Vector:
        """Displacement along each axis beyond which the object counts as kicked over [m]; nought without one."""
        return (0.0, 0.0, 0.0)

    @property
    def tipping_angle(self) -> float:
        """How far the object can be tilted before it counts as kicked over [rad]; nought where there is none."""
        return 0.0

    def targets(self, place: Array) -> tuple[Box, ...]:
        """Return what shows where the targets are; nothing where an object does.

        Args:
            place: Shape (d,) [m].
        """
        del place
        return ()

    @abstractmethod
    def missed_by(self, end: Array, target: Array, times: float) -> float:
        """Return how much nearer a motion should have come [m].

        Args:
            end: Of the motion, shape (3,) [m].
            target: Where it should have led, shape (3,) [m].
            times: How many times too far from its targets it passed, at least 1.
        """

    def check_place(self, place: Array, margin: float) -> None:
        """Let pass where a target of the scene can be.

        Args:
            place: Of the target, shape (d,) [m].
            margin: Beyond the region, on each axis [m].

        Raises:
            OutOfReach: No target can be there.
        """
        if not self.region.contains(place, margin):
            allowed = self.region.grown(margin)
            where = f"where targets of scene {self.name} can be"
            raise OutOfReach("the target at", place.tolist(), where, allowed.lower, allowed.upper)

    def check(self, variant: str) -> None:
        """Raise UnknownVariant unless the scene has the variant."""
        if variant not in self.variants:
            raise UnknownVariant(self.name, variant, self.variants)


def _joined(route: Corridor, start: Pose) -> Corridor:
    """Lead a route from another start onto itself: soon, since what stands around it was measured on the route."""
    covered = np.linspace(0.0, 1.0, len(route.positions))
    left = np.clip(1.0 - covered / _JOINED, 0.0, 1.0)[:, None] ** 2
    positions = route.positions + left * (start.position - route.positions[0])
    near = np.copysign(1.0, start.orientation @ route.orientations[1])  # q and -q are one orientation
    return Corridor(positions, np.vstack([near * start.orientation, route.orientations[1:]]))
