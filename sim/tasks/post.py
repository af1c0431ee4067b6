"""Reaching past a post on a low table: left or right of it, and for some places of the object straight on.

Variant clear has the table to itself; in post a post stands between the start and the object. How far the way has to
bend round it depends on how near to it the straight way passes: not at all where that passes beside it with room to
spare, by a hand's breadth where it leads through it, and beyond the middle of the post the other way round is shorter.
So the safe way is no affine function of the object's place, and where the straight way meets the middle of the post,
one person goes left of it and another one right.
"""

import math

import numpy as np

from sim.pose import Pose
from sim.region import Region
from sim.robots.gripper import pitched_down
from sim.tasks.furniture import table
from sim.tasks.reaching import ReachingScene
from sim.tasks.scene import Array, Box, Corridor, Eye, Group

_CLEAR, _POST = "clear", "post"
_TOP_Z = 0.50  # [m]
_OBJECT_Z = _TOP_Z + 0.05  # [m] of the centre of an object that stands on the table

_X, _Y = 0.66, 0.05  # [m] of the post
_HALF, _HEIGHT = 0.018, 0.11  # [m] half its thickness, and its height
_ROOM = 0.140  # [m] between the middles of post and hand: half of either, and what a person leaves free
_ROUNDING = 0.015  # [m] within which a way that is straight goes over into one that bends
_FURTHEST = 0.185  # [m] that a person bends a way at most, rather than going round the other side

_LACQUER = (0.78, 0.22, 0.17, 1.0)
_BAND = (0.95, 0.94, 0.91, 1.0)
_FOOT = (0.24, 0.25, 0.27, 1.0)


def _layout(variant: str) -> tuple[Box, ...]:
    return (*table((0.88, 0.0, _TOP_Z), 0.70, 1.20), *(_post() if variant == _POST else ()))


def _post() -> list[Box]:
    z, half_foot, wide = _TOP_Z + _HEIGHT / 2, 0.006, _HALF + 0.0005
    bands = [
        Box(f"post_band_{i}", (_X, _Y, _TOP_Z + h), (wide, wide, 0.007), _BAND, Group.DETAIL)
        for i, h in enumerate((0.060, 0.088))
    ]
    return [
        Box("post", (_X, _Y, z), (_HALF, _HALF, _HEIGHT / 2), _LACQUER),
        Box("post_foot", (_X, _Y, _TOP_Z + half_foot), (2.0 * _HALF, 2.0 * _HALF, half_foot), _FOOT),
        *bands,
    ]


_START = Pose(np.array([0.50, 0.0, 0.59]), pitched_down(math.radians(40.0)))

# Way-points between the start and the point before the object: x [m], share of the bend round the post.
_WAY = ((0.535, 0.60), (0.575, 1.0), (0.650, 1.0), (0.735, 0.93))
# Their heights, and those of the last three above the centre of the object [m]. Round the post the hand rises on, so
# that the palm, which comes after the fingers, passes above it; straight on it would not.
_HEIGHTS = {_CLEAR: (0.585, 0.575, 0.570, 0.570), _POST: (0.585, 0.580, 0.580, 0.615)}
_ABOVE = {_CLEAR: (0.025, 0.025, 0.020), _POST: (0.070, 0.045, 0.020)}
_NEAR = (-0.085, -0.045, -0.005)  # [m] x from the object: the fingers are clear of it, begin to enclose it, enclose it
_PITCHES = (40.0, 40.0, 40.0, 41.0, 42.0, 43.0, 44.0, 45.0)


def _routes(variant: str, object_position: Array) -> tuple[Corridor, ...]:
    """Both ways round the post, the shorter one first; only that where the other one is too far, or no post stands."""
    if variant == _CLEAR:
        return (_route(variant, object_position, 0.0),)
    beside = _slope(object_position) * (_X - _START.position[0]) + _START.position[1] - _Y
    bends = sorted((_bend(beside), -_bend(-beside)), key=abs)
    possible = (bend for n, bend in enumerate(bends) if n == 0 or abs(bend) <= _FURTHEST)
    return tuple(_route(variant, object_position, bend) for bend in possible)


def _slope(object_position: Array) -> float:
    """Of the straight way from the start to the point before the object: dy / dx."""
    x, y = object_position[:2] - _START.position[:2]
    return float(y / (x + _NEAR[0]))


def _bend(beside: float) -> float:
    """How far a way that passes the post's middle on its left by some metres has to bend to the left to be safe [m]."""
    missing = _ROOM - beside
    return 0.5 * (missing + math.hypot(missing, _ROUNDING))


def _route(variant: str, object_position: Array, bend: float) -> Corridor:
    (x0, y0), slope = _START.position[:2], _slope(object_position)
    way = [(x, y0 + slope * (x - x0) + share * bend, z) for (x, share), z in zip(_WAY, _HEIGHTS[variant], strict=True)]
    near = [object_position + np.array([x, 0.0, z]) for x, z in zip(_NEAR, _ABOVE[variant], strict=True)]
    positions = np.array([_START.position, *way, *near])
    return Corridor(positions, np.array([pitched_down(math.radians(pitch)) for pitch in _PITCHES]))


POST = ReachingScene(
    name="post",
    variants=(_CLEAR, _POST),
    start=_START,
    region=Region((0.86, -0.26, _OBJECT_Z), (0.91, 0.14, _OBJECT_Z)),
    training_positions=np.array([[0.885, -0.24, _OBJECT_Z], [0.885, 0.12, _OBJECT_Z]]),
    reached_radii=np.array([0.05, 0.065, 0.05]),
    kicked_thresholds=np.array([0.10, 0.10, 0.10]),
    layout=_layout,
    eye=Eye((0.30, -1.00, 1.05), (0.66, 0.02, 0.55)),
    routes=_routes,
)
