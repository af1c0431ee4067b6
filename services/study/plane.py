"""The plane of the thesis' 2D example in its own units: conditions, equation (25), and ways between the via-points."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Ellipse, Rectangle
from numpy.typing import NDArray

from lfd.trajectory import Trajectory
from protocol.messages import Condition, Mode
from services.rehearsal.result import Arrangement, Course
from services.study.analysis import Figure, Holds, Row
from services.study.models import KINDS, Kind
from services.study.style import DEMONSTRATION_LINE, OBSTACLE, REFINEMENT, TRUTH, Line, drawn, panels
from services.study.teaching import MODELS, Answer, Question, needed
from sim.scenes.particle import PARTICLE, X_UNIT, Y_UNIT
from sim.scenes.scene import Group

Array = NDArray[np.float64]
Values = tuple[float, float]
"""A condition in the thesis' units of y."""

NINE: tuple[Values, ...] = tuple((y_1, y_2) for y_1, y_2 in product((-10.0, 0.0, 10.0), repeat=2))
"""The conditions that both analyses go through, in the order of rows."""

_UNIT = np.array([X_UNIT, Y_UNIT])
_REFINED_LINE = Line(REFINEMENT, 3.4)
_THIN = 1.4  # [pt] of a prediction that is not compared with another model's
_FAILED = (0.0, (2.0, 1.5))
_SHOWN = ((0.0, -0.25, 0.0), (0.4, 0.25, 0.0))  # [m]
_COLUMNS = 3
_LIMITS = ((-0.1, 4.2), (-25.0, 25.0))  # of x and y, in the thesis' units


def arrangements(variant: str, conditions: Sequence[Values]) -> tuple[Arrangement, ...]:
    """Conditions in the thesis' units, in a variant of the scene."""
    return tuple(Arrangement(variant, condition=(y_1 * Y_UNIT, y_2 * Y_UNIT)) for y_1, y_2 in conditions)


def question(
    demonstrated: Sequence[Values], refined_in: str, beyond: Sequence[Values], demonstrated_in: str = "free"
) -> Question:
    """The nine conditions taught, then once more together with others.

    Args:
        demonstrated: that the models start from.
        refined_in: variant of the scene in which they are taught.
        beyond: conditions that are executed only.
        demonstrated_in: variant of the demonstrations.
    """
    return Question(
        PARTICLE,
        arrangements(demonstrated_in, demonstrated),
        arrangements(refined_in, NINE),
        arrangements(refined_in, (*NINE, *beyond)),
        _SHOWN,
    )


def named(condition: Condition | None) -> str:
    """A condition in the thesis' units, as it writes them."""
    y_1, y_2 = np.array(condition) / Y_UNIT
    return f"[{y_1:.0f}, {y_2:.0f}]"


def missed(trajectory: Trajectory, condition: Condition | None) -> Array:
    """How far a motion passes above each via-point, shape (2,), in the thesis' units."""
    x, y, _ = trajectory.positions.T
    return np.asarray((np.interp(PARTICLE.via_x, x, y) - np.array(condition)) / Y_UNIT, dtype=np.float64)


def mean_square_error(trajectory: Trajectory, condition: Condition | None) -> float:
    """Equation (25), in the thesis' units squared."""
    return float(np.mean(missed(trajectory, condition) ** 2))


def errors(courses: Sequence[Course]) -> list[float]:
    """Equation (25) of each course's first prediction."""
    return [mean_square_error(one.attempts[0].prediction, one.arrangement.condition) for one in courses]


def holds(answer: Answer, needed_by_thesis: int, failed_in_thesis: Sequence[Values] = ()) -> Holds:
    """Of the claim that the nine conditions are learnt, and which others then succeed.

    Args:
        answer: what came out.
        needed_by_thesis: conditions that needed a refinement there.
        failed_in_thesis: conditions beyond the nine that were not reached there.
    """
    conditioned = answer.of_kinds[0]
    excused = {one.condition for one in arrangements(answer.question.refined[0].variant, failed_in_thesis)}
    again, beyond = conditioned.second[: len(NINE)], conditioned.second[len(NINE) :]
    if not all(course.success for course in again):
        return Holds.NO
    others = all(course.success or course.arrangement.condition in excused for course in beyond)
    return Holds.YES if others and needed(conditioned) <= needed_by_thesis else Holds.DIFFERS


def sentence(answer: Answer, needed_by_thesis: int) -> str:
    """What came out, in words."""
    conditioned, adaptive = answer.of_kinds
    total = len(NINE)
    said = [
        f"The thesis' method needed refinements under {needed(conditioned)} of {total} conditions (in the thesis"
        f" {needed_by_thesis}), the default model under {needed(adaptive)}."
    ]
    for kind, rehearsed in zip(KINDS, answer.of_kinds, strict=True):
        again, beyond = rehearsed.second[:total], rehearsed.second[total:]
        lost = [named(one.arrangement.condition) for one in (*again, *beyond) if not one.success]
        said.append(
            f"Afterwards the {kind.label} succeeds under {_of(again)} of them and under {_of(beyond)} new ones"
            f"{', but not under ' + ', '.join(lost) if lost else ''}."
        )
    return " ".join(said)


def _of(courses: Sequence[Course]) -> str:
    return f"{sum(one.success for one in courses)} of {len(courses)}"


def rows(answer: Answer, needed_by_thesis: int, beyond_in_thesis: int) -> tuple[Row, ...]:
    """What the report's table says.

    Args:
        answer: what came out.
        needed_by_thesis: conditions that needed a refinement there.
        beyond_in_thesis: conditions beyond the nine that succeeded there, of as many as here.
    """
    total, kinds = len(NINE), answer.of_kinds
    beyond = len(answer.question.executed) - total

    def reached(courses: Sequence[Course]) -> int:
        return sum(one.success for one in courses)

    def furthest(courses: Sequence[Course]) -> float:
        each = [missed(one.attempts[0].measured, one.arrangement.condition) for one in courses]
        return float(np.max(np.abs(each)))

    counted = "updates of the model in all"
    return (
        Row(f"conditions that needed a refinement, of {total}", "", needed_by_thesis, *(needed(one) for one in kinds)),
        Row(counted, "", None, *(sum(course.updates for course in one.first) for one in kinds)),
        Row(f"conditions that succeed again, of {total}", "", total, *(reached(one.second[:total]) for one in kinds)),
        Row("mean square error of these", "", "0", *(float(np.mean(errors(one.second[:total]))) for one in kinds)),
        Row(f"new conditions, of {beyond}", "", beyond_in_thesis, *(reached(one.second[total:]) for one in kinds)),
        Row("furthest from a new via-point", "", None, *(furthest(one.second[total:]) for one in kinds)),
    )


def first_rounds(answer: Answer, caption: str) -> list[Figure]:
    """Predictions and refinements condition by condition, a figure for each model.

    Args:
        answer: what came out.
        caption: without the model's name.
    """
    figures = []
    for kind, model, rehearsed in zip(KINDS, MODELS, answer.of_kinds, strict=True):
        titles = [f"{i}: {named(one.arrangement.condition)}" for i, one in enumerate(rehearsed.first, 1)]
        canvas, panes = panels(titles, height=2.0, rows=_rows(len(titles)))
        for pane, course in zip(panes, rehearsed.first, strict=True):
            _lay_out(pane, course.arrangement.variant, [course.arrangement.condition])
            _draw_attempts(pane, course, kind, _THIN)
        figures.append(drawn(canvas, f"first-{model}", f"{caption}: {kind.label}."))
    return figures


def second_round(answer: Answer, caption: str) -> Figure:
    """The nine conditions once more, both models in one panel a condition.

    Args:
        answer: what came out.
        caption: of the figure.
    """
    titles = [named(one.condition) for one in answer.question.executed[: len(NINE)]]
    canvas, panes = panels(titles, height=2.0, rows=_rows(len(titles)))
    for number, pane in enumerate(panes):
        courses = [rehearsed.second[number] for rehearsed in answer.of_kinds]
        _lay_out(pane, courses[0].arrangement.variant, [courses[0].arrangement.condition])
        for kind, course in zip(KINDS, courses, strict=True):
            _draw_attempts(pane, course, kind, kind.line.linewidth)
    return drawn(canvas, "second", caption)


def beyond(answer: Answer, sizes: Sequence[float], caption: str) -> Figure:
    """The conditions that were never taught, a row of panels for each model.

    Args:
        answer: what came out.
        sizes: a panel each: the greatest of a condition's values, in the thesis' units.
        caption: of the figure.
    """
    titles = [f"{kind.label}: ±{size:.0f}" for kind in KINDS for size in sizes]
    canvas, panes = panels(titles, height=2.4, rows=len(KINDS))
    shown = [(kind, rehearsed, size) for kind, rehearsed in zip(KINDS, answer.of_kinds, strict=True) for size in sizes]
    for pane, (kind, rehearsed, size) in zip(panes, shown, strict=True):
        courses = [one for one in rehearsed.second[len(NINE) :] if _size(one.arrangement.condition) == size]
        _lay_out(pane, courses[0].arrangement.variant, [one.arrangement.condition for one in courses])
        for course in courses:
            _draw_attempts(pane, course, kind, _THIN)
    return drawn(canvas, "beyond", caption)


def demonstrations(answer: Answer, caption: str) -> Figure:
    """What both models started from, in the scene that they are taught in.

    Args:
        answer: what came out.
        caption: of the figure.
    """
    titles = [named(one.condition) for one in answer.question.demonstrated]
    canvas, panes = panels(titles, height=2.2)
    for pane, demonstration in zip(panes, answer.demonstrations, strict=True):
        _lay_out(pane, answer.question.refined[0].variant, [tuple(demonstration.condition.tolist())])
        _draw(pane, demonstration.trajectory, DEMONSTRATION_LINE, "demonstration")
    return drawn(canvas, "demonstrations", caption)


def learning_curve(answer: Answer, caption: str) -> Figure:
    """Equation (25) of the prediction for each condition, before it is refined, and once all have been seen.

    Args:
        answer: what came out.
        caption: of the figure.
    """
    canvas, (pane,) = panels([""], height=2.6)
    observed = np.arange(1, len(NINE) + 1)
    tolerated = (PARTICLE.tolerance / Y_UNIT) ** 2
    for kind, rehearsed in zip(KINDS, answer.of_kinds, strict=True):
        pane.plot(observed, errors(rehearsed.first), marker="o", markersize=5.0, **kind.line(f"{kind.label}: at first"))
        again = Line(kind.line.color, 0.6 * kind.line.linewidth, _FAILED)
        pane.plot(observed, errors(rehearsed.second[: len(NINE)]), **again(f"{kind.label}: after all nine"))
    names = [named(one.condition) for one in answer.question.refined]
    pane.set_xticks(observed, [f"{i}\n{name}" for i, name in enumerate(names, 1)])
    pane.axhline(tolerated, color=TRUTH, linewidth=0.8, label="both via-points missed by the tolerance")
    pane.set(xlabel="conditions observed, and the one that is predicted", ylabel="mean square error", yscale="log")
    return drawn(canvas, "error", caption)


def _rows(count: int) -> int:
    return -(-count // _COLUMNS)


def _size(condition: Condition | None) -> float:
    return float(np.round(np.max(np.abs(np.array(condition))) / Y_UNIT))


def _lay_out(pane: Axes, variant: str, conditions: Sequence[Condition | None]) -> None:
    """Axes in the thesis' units, the obstacle, and each condition's via-points as rings of the tolerance."""
    for box in PARTICLE.boxes(variant):
        if box.group is not Group.DETAIL:
            corner = (np.array(box.centre) - box.half_sizes)[:2] / _UNIT
            width, height = 2.0 * np.array(box.half_sizes)[:2] / _UNIT
            pane.add_patch(Rectangle((corner[0], corner[1]), width, height, color=OBSTACLE, alpha=0.45, linewidth=0.0))
    size = 2.0 * PARTICLE.tolerance / _UNIT
    for x, y in {(x, y) for one in conditions for x, y in zip(PARTICLE.via_x, one or (), strict=True)}:
        centre = np.array([x, y]) / _UNIT
        pane.add_patch(Ellipse((centre[0], centre[1]), *size, fill=False, edgecolor=TRUTH, linewidth=1.0, zorder=3.0))
    pane.set(xlim=_LIMITS[0], ylim=_LIMITS[1], xticks=range(5), yticks=range(-20, 21, 10))
    pane.set(xlabel="x", ylabel="y")
    pane.label_outer()


def _draw_attempts(pane: Axes, course: Course, kind: Kind, width: float) -> None:
    """Each episode's way, what succeeded in a width [pt]."""
    for attempt in course.attempts:
        if attempt.mode is Mode.REFINE:
            _draw(pane, attempt.refined, _REFINED_LINE, "refinement")
    for attempt in course.attempts:
        if attempt.mode is Mode.REFINE:
            continue
        if attempt.success:
            _draw(pane, attempt.prediction, Line(kind.line.color, width), f"{kind.label}: prediction")
        else:
            failed = Line(kind.line.color, _THIN, _FAILED)
            _draw(pane, attempt.prediction, failed, f"{kind.label}: prediction that failed")


def _draw(pane: Axes, trajectory: Trajectory, line: Line, label: str) -> None:
    pane.plot(*(trajectory.positions[:, :2] / _UNIT).T, **line(label))
