"""Taking an object out of the upper basket of a dishwasher (thesis, Section IV).

Variant b1 has the basket drawn out halfway; in b2 it is drawn out 0.18 m further, so that a motion
learnt in b1 runs its gripper up through the basket's front.
"""

import math

import numpy as np

from sim.pose import Pose
from sim.region import Region
from sim.robots.gripper import pitched_down
from sim.tasks.reaching import ReachingScene
from sim.tasks.scene import Array, Box, Corridor, Group

_B1, _B2 = "b1", "b2"
_BASKET_FRONT = {_B1: 0.73, _B2: 0.55}  # [m] x of the front panel
_BASKET_DEPTH, _BASKET_WIDTH = 0.50, 0.52  # [m]
_BASKET_Y = 0.07  # [m] of the middle
_FLOOR_Z, _RIM_Z = 0.495, 0.60  # [m]
_PANEL = 0.004  # [m] half thickness
_CABINET_FRONT = 1.02  # [m]

_OBJECT_Z = _FLOOR_Z + 2 * _PANEL + 0.05  # [m] of the centre of an object that stands in the basket

_STEEL = (0.62, 0.66, 0.70, 1.0)
_GLASS = (0.55, 0.70, 0.85, 0.16)
_WIRE = (0.86, 0.88, 0.91, 1.0)
_CABINET = (0.83, 0.84, 0.85, 1.0)
_INSIDE = (0.42, 0.44, 0.47, 1.0)
_WORKTOP = (0.36, 0.27, 0.21, 1.0)
_CROCKERY = ((0.93, 0.90, 0.84, 1.0), (0.45, 0.62, 0.70, 1.0), (0.85, 0.58, 0.42, 1.0))


def _layout(variant: str) -> tuple[Box, ...]:
    front = _BASKET_FRONT[variant]
    return (*_cabinet(), *_basket_panels(front), *_basket_wires(front), *_crockery(front))


def _cabinet() -> list[Box]:
    x, y, half_width, depth = _CABINET_FRONT, _BASKET_Y, 0.31, 0.30
    middle = x + depth
    return [
        Box("cabinet_left", (middle, y + half_width, 0.425), (depth, 0.02, 0.425), _CABINET),
        Box("cabinet_right", (middle, y - half_width, 0.425), (depth, 0.02, 0.425), _CABINET),
        Box("cabinet_back", (x + 2 * depth, y, 0.425), (0.02, half_width, 0.425), _INSIDE),
        Box("cabinet_floor", (middle, y, 0.06), (depth, half_width, 0.06), _INSIDE),
        Box("worktop", (middle - 0.01, y, 0.87), (depth + 0.03, half_width + 0.3, 0.02), _WORKTOP),
        Box("door", (x - 0.29, y, 0.10), (0.28, 0.29, 0.02), _STEEL),
        Box("neighbour_left", (middle, y + 0.48, 0.425), (depth, 0.14, 0.425), _CABINET),
        Box("neighbour_right", (middle, y - 0.48, 0.425), (depth, 0.14, 0.425), _CABINET),
    ]


def _basket_panels(front: float) -> list[Box]:
    x, y = front + _BASKET_DEPTH / 2, _BASKET_Y
    half_depth, half_width = _BASKET_DEPTH / 2, _BASKET_WIDTH / 2
    z, half_height = (_FLOOR_Z + _RIM_Z) / 2, (_RIM_Z - _FLOOR_Z) / 2
    return [
        Box("basket_floor", (x, y, _FLOOR_Z + _PANEL), (half_depth, half_width, _PANEL), _GLASS, Group.PANEL),
        Box("basket_front", (front + _PANEL, y, z), (_PANEL, half_width, half_height), _GLASS, Group.PANEL),
        Box("basket_back", (front + _BASKET_DEPTH, y, z), (_PANEL, half_width, half_height), _GLASS, Group.PANEL),
        Box("basket_left", (x, y + half_width, z), (half_depth, _PANEL, half_height), _GLASS, Group.PANEL),
        Box("basket_right", (x, y - half_width, z), (half_depth, _PANEL, half_height), _GLASS, Group.PANEL),
    ]


def _basket_wires(front: float) -> list[Box]:
    """The wires that a basket is made of; they lie within the panels and are only drawn."""
    x, y, wire = front + _BASKET_DEPTH / 2, _BASKET_Y, 0.0025
    half_depth, half_width = _BASKET_DEPTH / 2, _BASKET_WIDTH / 2
    z, half_height = (_FLOOR_Z + _RIM_Z) / 2, (_RIM_Z - _FLOOR_Z) / 2
    wires = []
    for height in (_RIM_Z, z, _FLOOR_Z + _PANEL):
        for side, sign in (("left", 1), ("right", -1)):
            centre = (x, y + sign * half_width, height)
            wires.append(Box(f"rail_{side}_{height:.2f}", centre, (half_depth, wire, wire), _WIRE, Group.DETAIL))
        for side, end in (("front", front + _PANEL), ("back", front + _BASKET_DEPTH)):
            centre = (end, y, height)
            wires.append(Box(f"rail_{side}_{height:.2f}", centre, (wire, half_width, wire), _WIRE, Group.DETAIL))
    for i, across in enumerate(np.linspace(-half_width, half_width, 14)):
        y_wire = y + float(across)
        wires.append(
            Box(f"floor_wire_{i}", (x, y_wire, _FLOOR_Z + _PANEL), (half_depth, wire, wire), _WIRE, Group.DETAIL)
        )
        for side, end in (("front", front + _PANEL), ("back", front + _BASKET_DEPTH)):
            centre = (end, y_wire, z)
            wires.append(Box(f"{side}_wire_{i}", centre, (wire, wire, half_height), _WIRE, Group.DETAIL))
    for i, along in enumerate(np.linspace(-half_depth, half_depth, 10)):
        for side, sign in (("left", 1), ("right", -1)):
            centre = (x + float(along), y + sign * half_width, z)
            wires.append(Box(f"{side}_wire_{i}", centre, (wire, wire, half_height), _WIRE, Group.DETAIL))
    return wires


def _crockery(front: float) -> list[Box]:
    """Plates that stand in the rear of the basket, out of the way."""
    lean = (math.cos(-0.1), 0.0, math.sin(-0.1), 0.0)
    x, z = front + _BASKET_DEPTH - 0.045, _FLOOR_Z + 0.09
    return [
        Box(f"plate_{i}", (x, _BASKET_Y - 0.17 + 0.17 * i, z), (0.005, 0.07, 0.075), rgba, quaternion=lean)
        for i, rgba in enumerate(_CROCKERY)
    ]


_START = Pose(np.array([0.537, 0.083, 0.444]), pitched_down(math.radians(38.0)))

# Way-points between the start and the object: x, z [m], share of the way sideways, pitch [deg].
_WAY = {
    _B1: ((0.590, 0.480, 0.10), (0.635, 0.570, 0.30), (0.655, 0.650, 0.50), (0.690, 0.725, 0.70), (0.765, 0.740, 0.90)),
    _B2: ((0.480, 0.450, 0.10), (0.470, 0.560, 0.30), (0.495, 0.660, 0.50), (0.600, 0.730, 0.70), (0.750, 0.750, 0.90)),
}
_PITCHES = (38.0, 38.0, 39.0, 41.0, 45.0, 50.0, 54.0, 56.0)
_ABOVE = np.array([-0.025, 0.0, 0.10])  # [m] from the centre of the object: the last point before going down
_GRASP = np.array([0.0, 0.0, 0.02])  # [m] from the centre of the object


def _routes(variant: str, object_position: Array) -> tuple[Corridor]:
    sideways = object_position[1] - _START.position[1]
    way = [(x, _START.position[1] + share * sideways, z) for x, z, share in _WAY[variant]]
    positions = np.array([_START.position, *way, object_position + _ABOVE, object_position + _GRASP])
    return (Corridor(positions, np.array([pitched_down(math.radians(pitch)) for pitch in _PITCHES])),)


DISHWASHER = ReachingScene(
    name="dishwasher",
    variants=(_B1, _B2),
    start=_START,
    region=Region((0.83, -0.08, _OBJECT_Z), (0.88, 0.22, _OBJECT_Z)),
    training_positions=np.array([[0.86, -0.06, _OBJECT_Z], [0.86, 0.20, _OBJECT_Z]]),
    reached_radii=np.array([0.05, 0.065, 0.05]),
    kicked_thresholds=np.array([0.15, 0.15, 0.15]),
    layout=_layout,
    routes=_routes,
)
