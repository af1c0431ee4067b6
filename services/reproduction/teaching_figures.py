"""Predictions and refinements of an arm in three dimensions, for the report."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from protocol.messages import Mode
from services.offline.result import Course
from services.reproduction.analysis import Figure
from services.reproduction.models import CONTENDERS, SHOWN, Contender
from services.reproduction.scenery import draw_way, furnish, place_object
from services.reproduction.style import DEMONSTRATION_LINE, REFINEMENT, Line, drawn, panels
from services.reproduction.teaching import Answer
from sim.tasks.scene import Vector

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Part = tuple[Vector, Vector]
"""Least and greatest corner of the part of space that is drawn [m]."""

REFINEMENT_LINE = Line(REFINEMENT, 1.4)
_COLUMNS = 4


def first_rounds(answer: Answer, part: Part, titles: Sequence[str], caption: str) -> list[Figure]:
    """Predictions and refinements condition by condition, a figure for each of `SHOWN`.

    Args:
        answer: what came out.
        part: of space.
        titles: of the conditions.
        caption: without the model's name.
    """
    figures = []
    for kind in SHOWN:
        height = 2.9 if len(titles) <= _COLUMNS else 3.3
        canvas, panes = panels(titles, height=height, rows=-(-len(titles) // _COLUMNS), solid=True)
        for axes, course in zip(panes, answer.first(kind), strict=True):
            furnish(axes, answer.question.scene.boxes(course.arrangement.variant), *part)
            place_object(axes, course.arrangement.place.tolist())
            _draw_course(axes, course, kind)
        figures.append(drawn(canvas, f"first-{kind.name}", f"{caption}: {kind.label}.", raster=True))
    return figures


def second_round(answer: Answer, part: Part, caption: str) -> Figure:
    """All predictions of the second round, a panel for each model, with the demonstrations that they started from.

    Args:
        answer: what came out.
        part: of space.
        caption: of the figure.
    """
    question = answer.question
    canvas, panes = panels([kind.label for kind in CONTENDERS], height=3.1, rows=2, solid=True)
    for axes, kind in zip(panes, CONTENDERS, strict=True):
        furnish(axes, question.scene.boxes(question.executed[-1].variant), *part)
        for demonstration in answer.demonstrations:
            draw_way(axes, demonstration.trajectory.positions, DEMONSTRATION_LINE, "demonstration")
        for course in answer.second(kind):
            place_object(axes, course.arrangement.place.tolist())
            _draw_course(axes, course, kind)
    return drawn(canvas, "second", caption, raster=True)


def prediction_line(kind: Contender, *, success: bool) -> tuple[Line, str]:
    """How a prediction is drawn that succeeded, or one that failed, and what it is called."""
    if success:
        return Line(kind.line.color, 1.3), f"{kind.label}: prediction"
    return Line(kind.line.color, 1.3, (0.0, (2.0, 1.5))), f"{kind.label}: prediction that failed"


def _draw_course(axes: Axes, course: Course, kind: Contender) -> None:
    for attempt in course.attempts:
        if attempt.mode is Mode.REFINE:
            draw_way(axes, attempt.refined.positions, REFINEMENT_LINE, "refinement")
        else:
            draw_way(axes, attempt.prediction.positions, *prediction_line(kind, success=attempt.success))
