"""The picture of a map: object positions from above and starts from the side, before a correction and after it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

from lfd.motion.rotations import matrix_from_quaternion
from services.reproduction.analysis import Figure
from services.reproduction.models import Contender
from services.reproduction.style import ADAPTIVE, CONDITIONED, OBSTACLE, REFINEMENT, TRUTH, drawn, panels
from services.success_map.conditions import Condition, Ending, SuccessMap, stage_name
from sim.tasks.scene import OBJECT_SIZE, Box, Group, ReachingScene

Array = NDArray[np.float64]

_HEIGHT = 3.1  # [inch] of a row
_EDGE = "#7c8794"
_BELOW, _ABOVE = OBJECT_SIZE[2], 0.25  # [m] an object's centre: the slice that is seen from above


@dataclass(frozen=True)
class _Mark:
    color: str
    shape: str
    size: float


# The shapes differ too: not everybody sees the colours.
_MARKS = {
    Ending.REACHED: _Mark(REFINEMENT, "o", 13.0),
    Ending.COLLISION: _Mark(CONDITIONED, "x", 15.0),
    Ending.KICKED_OVER: _Mark(OBSTACLE, "^", 17.0),
    Ending.NOT_REACHED: _Mark(ADAPTIVE, "s", 12.0),
    Ending.UNREACHABLE: _Mark("#b6bec8", ".", 9.0),
}


@dataclass(frozen=True)
class _View:
    """A way to look at a scene.

    Attributes:
        across: axis of space to the right.
        up: axis upwards.
        mirrored: the axis across points left, as y does for the robot.
        from_start: positions are relative to the scene's start.
        room: around what is marked [m].
        size: of the marks, as a share: objects stand closer together on paper than starts.
        point: what is marked of a condition, shape (3,) [m].
        labels: of the axes.
    """

    across: int
    up: int
    mirrored: bool
    from_start: bool
    room: float
    size: float
    point: Callable[[Condition], Array]
    labels: tuple[str, str]


_FROM_ABOVE = _View(
    across=1,
    up=0,
    mirrored=True,
    from_start=False,
    room=0.06,
    size=0.4,
    point=lambda one: np.array(one.place.object_position),
    labels=("y [m]", "x [m]"),
)
_FROM_THE_SIDE = _View(
    across=0,
    up=2,
    mirrored=False,
    from_start=True,
    room=0.02,
    size=1.0,
    point=lambda one: np.array(one.place.offset),
    labels=("x from the scene's start [m]", "z from the scene's start [m]"),
)


def figure(scene: ReachingScene, found: SuccessMap, kind: Contender) -> Figure:
    """A column for each stage: above it where the object stood, below it where the motion started.

    Args:
        scene: of the map.
        found: the map.
        kind: of the model.
    """
    stages = range(len(found.corrections))
    names = [stage_name(n, before=n == 0) for n in found.corrections]
    titles = [f"{name}: object positions, from above" for name in names]
    titles += [f"{name}: starts, from the side" for name in names]
    canvas, panes = panels(titles, height=_HEIGHT, rows=2)
    boxes = [box for box in scene.boxes(found.variant) if box.group is not Group.DETAIL]
    z, y = scene.region.lower[2], scene.start.position[1]
    seen = _within(boxes, 2, z - _BELOW, z + _ABOVE), _within(boxes, 1, y, y)
    for stage in stages:
        for number, view in enumerate((_FROM_ABOVE, _FROM_THE_SIDE)):
            axes = panes[number * len(stages) + stage]
            origin = scene.start.position * view.from_start
            _draw(axes, view, found, stage)
            start = scene.start.position - origin
            axes.plot(start[view.across], start[view.up], "+", color=TRUTH, markersize=9.0, label="the scene's start")
            _outline(axes, view, seen[number], origin)
    canvas.suptitle(f"{scene.name}, {found.variant}: {kind.label}\n{found.summary()}", fontsize=9.5)
    return drawn(canvas, "map", "", raster=True)


def _draw(axes: Axes, view: _View, found: SuccessMap, stage: int) -> None:
    points = np.array([view.point(one) for one in found.conditions])
    for outcome, mark in _MARKS.items():
        chosen = [one.trials[stage].outcome is outcome for one in found.conditions]
        counts = [found.count(n, outcome) for n in range(len(found.corrections))]
        if any(counts):
            label = f"{outcome.value}: {' → '.join(map(str, counts))}"
            x, y = points[chosen][:, [view.across, view.up]].T
            axes.scatter(x, y, s=view.size * mark.size, c=mark.color, marker=mark.shape, linewidths=1.0, label=label)
    axes.set(xlabel=view.labels[0], ylabel=view.labels[1], aspect="equal", adjustable="datalim")
    if view.mirrored:
        axes.xaxis.set_inverted(True)


def _within(boxes: list[Box], axis: int, lower: float, upper: float) -> list[Box]:
    """The boxes that reach into a slice of space [m]."""
    corners = [(box, *_extent(box)) for box in boxes]
    return [box for box, low, high in corners if low[axis] <= upper and high[axis] >= lower]


def _outline(axes: Axes, view: _View, boxes: list[Box], origin: Array) -> None:
    """Draw boxes around what is shown already, without showing more than a little of them."""
    shown = axes.get_xlim(), axes.get_ylim()
    for box in boxes:
        low, high = (corner - origin for corner in _extent(box))
        width, height = (high - low)[view.across], (high - low)[view.up]
        corner = (low[view.across], low[view.up])
        axes.add_patch(Rectangle(corner, width, height, facecolor=(*box.rgba[:3], 0.16), edgecolor=_EDGE, lw=0.8))
    (x0, x1), (y0, y1) = shown
    room = view.room if x1 > x0 else -view.room
    # Automatic, so that what is equal in both directions may widen them.
    axes.set_xlim(x0 - room, x1 + room, auto=True)
    axes.set_ylim(y0 - view.room, y1 + view.room, auto=True)


def _extent(box: Box) -> tuple[Array, Array]:
    """Least and greatest corner of the upright box around a box [m]."""
    half = np.abs(matrix_from_quaternion(np.array(box.quaternion))) @ np.array(box.half_sizes)
    return np.array(box.centre) - half, np.array(box.centre) + half
