"""Features of a depth picture: where a thing in front of the robot begins, how high its rim is, how large an object is.

Each is measured within a box of the base frame, and none is where it is not seen for certain.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from services.bus.arrays import Floats
from services.perception.placement import Matrix
from sim.region import Region

BAND_M = 0.02
"""What lies so close behind the outermost point belongs to the same surface: twice as deep as depth cameras scatter."""

OUTER = 0.25
"""Share of the band's points that are further out than where it is said to end: a face across the axis lies there with
all of its noise, of one along it the edge alone."""

FEWEST = 20
"""Points that make a surface; fewer are stray ones."""

SHARE = 0.02
"""Of the points in the box that a surface has at least."""

CUT_OFF = 0.1
"""Where more of a surface's points than this share lie at the picture's rim, it goes on beyond."""

Mask = NDArray[np.bool_]


class Size(NamedTuple):
    """Of a thing, as far as it is seen from one side, along the base's axes [m]."""

    x: float
    y: float
    z: float


def organised(depth: Floats, intrinsics: tuple[float, float, float, float], base_from_camera: Matrix) -> Floats:
    """Every pixel's point in the base frame, shape (height, width, 3) [m]; not finite where the depth is not known.

    Args:
        depth: along the optical axis, shape (height, width) [m].
        intrinsics: of the pinhole: fx, fy, cx, cy [pixel].
        base_from_camera: placement of the optical frame (x right, y down, z forward) in the base frame.
    """
    fx, fy, cx, cy = intrinsics
    rows, columns = np.indices(depth.shape)
    known = np.where(np.isfinite(depth), depth, np.nan)
    in_camera = np.stack([(columns - cx) / fx * known, (rows - cy) / fy * known, known], axis=-1)
    points: Floats = in_camera @ base_from_camera[:3, :3].T + base_from_camera[:3, 3]
    return points


def front_edge(cloud: Floats, box: Region) -> float | None:
    """Where what is in the box begins, as seen from the robot: its least x [m].

    Args:
        cloud: shape (height, width, 3), base frame [m].
        box: base frame [m].

    Returns:
        None where nothing is there, or where it goes on beyond the picture.
    """
    return _outermost(cloud, _inside(cloud, box), cloud[..., 0])


def rim_height(cloud: Floats, box: Region) -> float | None:
    """How high what is in the box goes: its greatest z [m]; arguments and None as for `front_edge`."""
    top = _outermost(cloud, _inside(cloud, box), -cloud[..., 2])
    return None if top is None else -top


def size(cloud: Floats, box: Region) -> Size | None:
    """How large what is in the box is; arguments and None as for `front_edge`.

    The thing stands on the lower face of the box: what lies no higher than `BAND_M` above that is what it stands on.
    """
    (x, y, floor), upper = box.lower, box.upper
    inside = _inside(cloud, Region((x, y, floor + BAND_M), upper))
    least = [_outermost(cloud, inside, cloud[..., axis]) for axis in range(2)]
    most = [_outermost(cloud, inside, -cloud[..., axis]) for axis in range(3)]
    if None in least or None in most:
        return None
    (x0, y0), (x1, y1, top) = np.array(least, dtype=np.float64), -np.array(most, dtype=np.float64)
    return Size(float(x1 - x0), float(y1 - y0), float(top - floor))


def _inside(cloud: Floats, box: Region) -> Mask:
    with np.errstate(invalid="ignore"):
        inside: Mask = np.all((cloud >= np.array(box.lower)) & (cloud <= np.array(box.upper)), axis=-1)
    return inside


def _outermost(cloud: Floats, inside: Mask, along: Floats) -> float | None:
    """The least value along an axis of a surface in the box.

    Of what lies in the first band that has enough points: neither a stray point nor noise moves it much.
    """
    values = np.sort(along[inside])
    fewest = max(FEWEST, round(SHARE * len(values)))
    if len(values) < fewest:
        return None
    enough = values[fewest - 1 :] - values[: len(values) - fewest + 1] <= BAND_M
    if not np.any(enough):
        return None
    first = values[int(np.argmax(enough))]
    surface = inside & (along >= first) & (along <= first + BAND_M)
    rim = np.ones(cloud.shape[:2], dtype=bool)
    rim[1:-1, 1:-1] = False
    if np.mean(rim[surface]) > CUT_OFF:
        return None
    return float(np.quantile(along[surface], OUTER))
