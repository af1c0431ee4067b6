"""A particle that passes through two via-points: the thesis' 2D example (Sections III-A and IV-A, Appendix B).

The particle moves along x at a constant speed, from 0 to 4, and a person moves it in y. The condition is the y of the
via-points, which stand at x = 2.0 and 3.6.

Scale: the thesis gives no lengths. One unit of its x is 0.1 m and one unit of its y is 0.01 m, conditions included, so
that x runs over 0.4 m and +-20 is +-0.2 m. A stylus that is displaced by d metres moves the particle by d: with the
thesis' normalised master position p = d / 0.1 m this is y = 10 p in its units, equation (24) with beta = 10.

Variant free has nothing in the way; obstacle has a block whose lower left corner is at x = 0.5 (Fig. 13). The thesis
does not give its size. This one lies in every way that was taught without it for a condition within +-20, those of
Fig. B.3 among them, and leaves room above it for a way to every such condition: one way for all, so that it can be
learnt.
"""

import math
from dataclasses import dataclass

import numpy as np

from sim.interpolation import minimum_jerk
from sim.pose import Pose
from sim.region import Region
from sim.robots.robot import PARTICLE as PARTICLE_ROBOT
from sim.robots.robot import Robot
from sim.tasks.scene import NO_ROTATION, Array, Box, Corridor, Eye, Freedom, Group, Scene, Vector

X_UNIT, Y_UNIT = 0.1, 0.01  # [m] of the thesis' axes

_FREE, _OBSTACLE = "free", "obstacle"
_END = 4.0 * X_UNIT
_VIA_X = (2.0 * X_UNIT, 3.6 * X_UNIT)
_BLOCK = ((0.5 * X_UNIT, -6.0 * Y_UNIT), (0.9 * X_UNIT, 2.5 * Y_UNIT))  # [m] lower left and upper right corner
_PASSAGE = ((0.42 * X_UNIT, 5.5 * Y_UNIT), (1.0 * X_UNIT, 5.5 * Y_UNIT))  # [m] as far above the block as people keep
_BOARD_Z = -0.006  # [m] of the board that the particle rolls on
_WAY_POINTS = 81
_RING_SEGMENTS = 20

_WOOD = (0.78, 0.77, 0.74, 1.0)
_LINE = (0.64, 0.64, 0.63, 1.0)
_AXIS = (0.42, 0.43, 0.45, 1.0)
_BRICK = (0.66, 0.34, 0.25, 1.0)
_BLUE = (0.13, 0.42, 0.78, 1.0)


@dataclass(frozen=True, eq=False, kw_only=True)
class ParticleScene(Scene):
    """A particle passes through via-points in the plane z = 0; a place is their y, shape (2,) [m].

    Attributes:
        via_x: Of the via-points [m].
        tolerance: How far the particle may pass beside a via-point, in y [m]; the thesis states none.
        radius: Of the particle [m].
    """

    has_object = False

    via_x: tuple[float, float]
    tolerance: float
    radius: float

    @property
    def robot(self) -> Robot:
        """See `Scene.robot`: the particle, whatever arms there are."""
        return PARTICLE_ROBOT

    @property
    def posture(self) -> Array:
        """See `Scene.posture`."""
        return np.zeros(3)

    @property
    def point(self) -> float:
        """See `Scene.point`."""
        return self.radius

    @property
    def tolerances(self) -> Vector:
        """See `Scene.tolerances`."""
        return (self.tolerance,) * 3

    def layout(self, variant: str) -> tuple[Box, ...]:
        """See `Scene.layout`."""
        return (*_board(), *(_block() if variant == _OBSTACLE else ()))

    def routes(self, variant: str, place: Array) -> tuple[Corridor, ...]:
        """See `Scene.routes`: a line that is level at its knots, and passes from one to the next as a hand does."""
        return (_route(variant, place),)

    def targets(self, place: Array) -> tuple[Box, ...]:
        """See `Scene.targets`: the rings."""
        first, second = self.rings(place)
        return (*first, *second)

    def missed_by(self, end: Array, target: Array, times: float) -> float:
        """See `Scene.missed_by`; at the worse via-point."""
        del end, target
        return self.tolerance * (times - 1.0)

    def rings(self, place: Array) -> tuple[tuple[Box, ...], tuple[Box, ...]]:
        """Return the via-points, each as a ring of boxes that the particle passes through within the tolerance.

        Args:
            place: y of the via-points, shape (2,) [m].
        """
        first, second = (
            _ring(f"via_point_{i}", x, y, self.tolerance)
            for i, (x, y) in enumerate(zip(self.via_x, place.tolist(), strict=True), 1)
        )
        return first, second


def _ring(name: str, x: float, y: float, radius: float) -> tuple[Box, ...]:
    step = 2.0 * math.pi / _RING_SEGMENTS
    length = radius * math.tan(step / 2.0)
    return tuple(
        Box(
            f"{name}_{k}",
            (x + radius * math.cos(k * step), y + radius * math.sin(k * step), 0.0),
            (0.0018, 1.15 * length, 0.0018),
            _BLUE,
            Group.DETAIL,
            (math.cos(k * step / 2.0), 0.0, 0.0, math.sin(k * step / 2.0)),
        )
        for k in range(_RING_SEGMENTS)
    )


def _board() -> list[Box]:
    """The plane of the thesis' figures, a line at every unit of x and every ten of y."""
    middle, half_length, half_width, thin = _END / 2, 0.22, 0.23, 0.0008
    board = Box("board", (middle, 0.0, _BOARD_Z - 0.005), (half_length, half_width, 0.005), _WOOD, Group.DETAIL)
    across = [
        Box(f"x_{i}", (i * X_UNIT, 0.0, _BOARD_Z), (thin, half_width, thin / 2), _LINE, Group.DETAIL) for i in range(5)
    ]
    along = [
        Box(
            f"y_{i}",
            (middle, 10.0 * i * Y_UNIT, _BOARD_Z),
            (half_length, thin if i else 2.0 * thin, thin / 2),
            _LINE if i else _AXIS,
            Group.DETAIL,
        )
        for i in range(-2, 3)
    ]
    return [board, *across, *along]


def _block() -> list[Box]:
    lower, upper = np.array(_BLOCK)
    (x, y), (half_x, half_y) = ((lower + upper) / 2).tolist(), ((upper - lower) / 2).tolist()
    height = 0.012
    return [Box("block", (x, y, _BOARD_Z + height), (half_x, half_y, height), _BRICK)]


def _route(variant: str, place: Array) -> Corridor:
    (x_1, x_2), (y_1, y_2) = _VIA_X, place.tolist()
    passage = _PASSAGE if variant == _OBSTACLE else ()
    knots = np.array([(0.0, 0.0), *passage, (x_1, y_1), (x_2, y_2), (_END, y_2)])
    x = np.linspace(0.0, _END, _WAY_POINTS)
    leg = np.clip(np.searchsorted(knots[:, 0], x, side="right") - 1, 0, len(knots) - 2)
    (x_from, y_from), (x_to, y_to) = knots[leg].T, knots[leg + 1].T
    y = y_from + (y_to - y_from) * minimum_jerk((x - x_from) / (x_to - x_from))
    positions = np.column_stack([x, y, np.zeros(_WAY_POINTS)])
    return Corridor(positions, np.tile(NO_ROTATION, (_WAY_POINTS, 1)))


OBSTACLE_TRAINING = Y_UNIT * np.array([[10.0, 10.0], [10.0, -10.0], [-10.0, 0.0]])
"""Conditions of the demonstrations, made without the obstacle, that the thesis' analysis of it begins with (Fig. B.3),
shape (3, 2) [m]."""

PARTICLE = ParticleScene(
    name="particle",
    variants=(_FREE, _OBSTACLE),
    start=Pose(np.zeros(3), np.array(NO_ROTATION)),
    region=Region((-10.0 * Y_UNIT,) * 2, (10.0 * Y_UNIT,) * 2),
    margin=10.0 * Y_UNIT,
    training_positions=np.zeros((1, 2)),
    freedom=Freedom(axes=(0.0, 1.0, 0.0), tempo=False, targets=tuple(x / _END for x in _VIA_X)),
    eye=Eye((0.2, -0.25, 0.58), (0.2, -0.01, 0.0)),
    via_x=_VIA_X,
    tolerance=1.0 * Y_UNIT,
    radius=0.006,
)
