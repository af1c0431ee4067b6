"""Scenes and motions in three dimensions, for the report."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from lfd.motion.rotations import matrix_from_quaternion
from services.reproduction.style import Line
from sim.tasks import DISHWASHER
from sim.tasks.scene import Box, Group, Vector

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection
    from mpl_toolkits.mplot3d.axes3d import Axes3D

Array = NDArray[np.float64]

OBJECT = "#3c6e57"

# The corners of a unit cube, and its faces as rings of them.
_CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float64)
_FACES = ((0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5))
_VIEW = {"elev": 22.0, "azim": -60.0}  # [deg]
_ZOOM = 1.15


def solid(axes: Axes) -> Axes3D:
    """The axes, which are of three dimensions."""
    from mpl_toolkits.mplot3d.axes3d import Axes3D  # noqa: PLC0415 - see `style`

    if not isinstance(axes, Axes3D):
        raise TypeError("these axes have two dimensions")
    return axes


def furnish(axes: Axes, boxes: Sequence[Box], lower: Vector, upper: Vector) -> None:
    """Draw what of a scene lies in a part of space, and show that part at one scale.

    Args:
        axes: of three dimensions.
        boxes: of the scene; what is only drawn by the cameras is left out.
        lower: least corner of the part [m].
        upper: greatest corner [m].
    """
    pane = solid(axes)
    # What is drawn later lies in front: the automatic order cuts translucent faces through what stands on them.
    pane.computed_zorder = False
    for box in boxes:
        corners = box.centre + (_CORNERS * box.half_sizes) @ matrix_from_quaternion(np.array(box.quaternion)).T
        if box.group is Group.DETAIL or np.any(corners.min(axis=0) > upper) or np.any(corners.max(axis=0) < lower):
            continue
        corners = np.clip(corners, lower, upper)
        alpha = 0.10 if box.group is Group.PANEL else 0.22
        pane.add_collection3d(
            _block(corners, facecolors=box.rgba[:3], edgecolors="#7c8794", linewidths=0.4, alpha=alpha)
        )
    pane.set(xlim=(lower[0], upper[0]), ylim=(lower[1], upper[1]), zlim=(lower[2], upper[2]))
    pane.set_box_aspect(np.subtract(upper, lower).tolist(), zoom=_ZOOM)
    pane.locator_params(nbins=4)
    pane.view_init(**_VIEW)
    pane.tick_params(labelsize=6.0, pad=-2.0)
    pane.set_xlabel("x [m]", labelpad=-6.0, fontsize=7.0)
    pane.set_ylabel("y [m]", labelpad=-6.0, fontsize=7.0)
    pane.set_zlabel("z [m]", labelpad=-6.0, fontsize=7.0)


def place_object(axes: Axes, position: Sequence[float]) -> None:
    """Draw the object, its centre at a position [m]."""
    corners = np.asarray(position) + _CORNERS * np.array(DISHWASHER.object_size) / 2
    solid(axes).add_collection3d(_block(corners, facecolors=OBJECT, edgecolors="white", linewidths=0.3))


def draw_way(axes: Axes, positions: Array, line: Line, label: str | None = None) -> None:
    """Draw a motion's positions, shape (n, 3) [m]."""
    solid(axes).plot(*positions.T, **line(label))


def _block(corners: Array, **look: Any) -> Poly3DCollection:
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: PLC0415 - see `style`

    return Poly3DCollection([corners[list(face)] for face in _FACES], **look)
