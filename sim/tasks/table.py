"""Reaching for an object on a table (thesis, Section V).

Variant clear has the table to itself; in box a low box stands between the start and the object, so
that a motion learnt in clear, which sweeps just above the table, runs into it.
"""

import math

import numpy as np

from sim.pose import Pose
from sim.region import Region
from sim.robots.gripper import pitched_down
from sim.tasks.furniture import table
from sim.tasks.reaching import ReachingScene
from sim.tasks.scene import Array, Box, Corridor

_CLEAR, _BOX = "clear", "box"
_TOP_Z = 0.66  # [m]
_OBJECT_Z = _TOP_Z + 0.05  # [m] of the centre of an object that stands on the table

_CARDBOARD = (0.80, 0.64, 0.42, 1.0)
_TAPE = (0.90, 0.82, 0.66, 1.0)


def _layout(variant: str) -> tuple[Box, ...]:
    return (*table((0.83, 0.0, _TOP_Z), 0.80, 1.40), *(_parcel() if variant == _BOX else ()))


def _parcel() -> list[Box]:
    centre, half = (0.72, -0.15, _TOP_Z + 0.05), (0.19, 0.03, 0.05)
    return [
        Box("parcel", centre, half, _CARDBOARD),
        Box("parcel_tape", centre, (half[0] + 0.001, 0.008, half[2] + 0.001), _TAPE),
    ]


_START = Pose(np.array([0.60, -0.33, 0.74]), pitched_down(math.radians(38.0)))

# Way-points between the start and the object: share of the way to the point before the object, height z [m].
_WAY = {
    _CLEAR: ((0.15, 0.735), (0.40, 0.735), (0.65, 0.740), (0.88, 0.740)),
    _BOX: ((0.10, 0.810), (0.38, 0.855), (0.65, 0.855), (0.88, 0.815)),
}
_PITCHES = (38.0, 38.0, 38.0, 39.0, 40.0, 42.0, 44.0)
_BEFORE = np.array([-0.12, 0.0])  # [m] from the object, on the table: the fingers are still clear of it
_CLOSE = np.array([-0.08, 0.0, 0.035])  # [m] from the centre of the object: the fingers begin to enclose it
_GRASP = np.array([-0.005, 0.0, 0.02])  # [m] from the centre of the object


def _routes(variant: str, object_position: Array) -> tuple[Corridor]:
    start = _START.position
    ahead = object_position[:2] + _BEFORE - start[:2]
    way = [(*(start[:2] + share * ahead), z) for share, z in _WAY[variant]]
    positions = np.array([start, *way, object_position + _CLOSE, object_position + _GRASP])
    return (Corridor(positions, np.array([pitched_down(math.radians(pitch)) for pitch in _PITCHES])),)


TABLE = ReachingScene(
    name="table",
    variants=(_CLEAR, _BOX),
    start=_START,
    region=Region((0.65, 0.02, _OBJECT_Z), (0.85, 0.24, _OBJECT_Z)),
    training_positions=np.array(
        [[0.67, 0.04, _OBJECT_Z], [0.67, 0.22, _OBJECT_Z], [0.83, 0.04, _OBJECT_Z], [0.83, 0.22, _OBJECT_Z]]
    ),
    reached_radii=np.array([0.05, 0.065, 0.05]),
    kicked_thresholds=np.array([0.10, 0.10, 0.10]),
    layout=_layout,
    routes=_routes,
)
