"""The picture of a map: targets and starts, before a correction and after it, and where the corrections were given."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lfd.motion.rotations import matrix_from_quaternion
from services.reproduction.analysis import Figure
from services.reproduction.models import Contender
from services.reproduction.style import ADAPTIVE, CONDITIONED, OBSTACLE, REFINEMENT, TRUTH, drawn, panels
from services.success_map.conditions import Condition, Ending, SuccessMap, Target, stage_name
from sim.tasks import AnyScene
from sim.tasks.scene import Box, Group

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]

_HEIGHT = 3.1  # [inch] of a row
_EDGE = "#7c8794"
_START = "the scene's start"
_BELOW, _ABOVE = 0.6, 0.25  # of its height below an object's centre, and [m] above: what is seen from above


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
        point: what is marked of a condition, shape (d,) [m].
        labels: of the axes.
        title: what is seen.
        slice: axis of space, least and greatest value of what stands around it; None where nothing does [m].
        corrections: places of corrections are marked.
    """

    across: int
    up: int
    mirrored: bool
    from_start: bool
    room: float
    size: float
    point: Callable[[Condition], Array]
    labels: tuple[str, str]
    title: str
    slice: tuple[int, float, float] | None = None
    corrections: bool = False


def _views(scene: AnyScene) -> tuple[_View, ...]:
    """Objects from above and starts from the side; or the conditions themselves, whose starts differ along y alone."""
    if not scene.has_object:
        return (
            _View(
                across=0,
                up=1,
                mirrored=False,
                from_start=False,
                room=0.02,
                size=1.6,
                point=lambda one: np.array(one.setting.target),
                labels=("y of the first via-point [m]", "y of the second via-point [m]"),
                title="conditions",
                corrections=True,
            ),
        )
    z, y = scene.region.lower[2], float(scene.start.position[1])
    return (
        _View(
            across=1,
            up=0,
            mirrored=True,
            from_start=False,
            room=0.06,
            size=0.4,
            point=lambda one: np.array(one.setting.target),
            labels=("y [m]", "x [m]"),
            title="object positions, from above",
            slice=(2, z - _BELOW * scene.object_size[2], z + _ABOVE),
            corrections=True,
        ),
        _View(
            across=0,
            up=2,
            mirrored=False,
            from_start=True,
            room=0.02,
            size=1.0,
            point=lambda one: np.array(one.setting.offset),
            labels=("x from the scene's start [m]", "z from the scene's start [m]"),
            title="starts, from the side",
            slice=(1, y, y),
        ),
    )


def figure(scene: AnyScene, found: SuccessMap, kind: Contender) -> Figure:
    """A column for each stage: above it the targets, below it where the motion started; corrections by their number.

    Args:
        scene: of the map.
        found: the map.
        kind: of the model.
    """
    stages, views = range(len(found.corrections)), _views(scene)
    names = [stage_name(n, before=n == 0) for n in found.corrections]
    titles = [f"{name}: {view.title}" for view in views for name in names]
    canvas, panes = panels(titles, height=_HEIGHT + 0.6 * (len(views) == 1), rows=len(views))
    boxes = [box for box in scene.boxes(found.variant) if box.group is not Group.DETAIL]
    for number, view in enumerate(views):
        for stage in stages:
            axes = panes[number * len(stages) + stage]
            _draw(axes, view, found, stage)
            if view.corrections:
                _number(axes, view, found.corrected[: found.corrections[stage]])
            if view.slice is not None:
                origin = scene.start.position * view.from_start
                start = scene.start.position - origin
                axes.plot(start[view.across], start[view.up], "+", color=TRUTH, markersize=9.0, label=_START)
                _outline(axes, view, _within(boxes, *view.slice), origin)
    canvas.suptitle(
        f"{scene.name}, {found.variant}: {kind.label}\n" + found.summary().replace("; ", "\n"), fontsize=9.5
    )
    return drawn(canvas, "map", "", raster=True)


def _number(axes: Axes, view: _View, places: Sequence[Target]) -> None:
    """Mark where corrections were given by their numbers, joined in their order."""
    if not places:
        return
    across, up = (np.array([place[axis] for place in places]) for axis in (view.across, view.up))
    axes.plot(across, up, color=TRUTH, linewidth=0.7, linestyle=(0.0, (3.0, 2.0)), zorder=4.0)
    label = "corrections, in their order"
    axes.scatter(across, up, s=62.0, c="white", edgecolors=TRUTH, linewidths=1.0, zorder=5.0, label=label)
    for number, (x, y) in enumerate(zip(across, up, strict=True), 1):
        axes.annotate(str(number), (x, y), ha="center", va="center_baseline", fontsize=6.5, zorder=6.0)


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
    from matplotlib.patches import Rectangle  # noqa: PLC0415 - see `style`

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
