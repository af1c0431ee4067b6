"""The 2D example: via-points that a particle is to pass through, without and with an obstacle in the way."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import product

import msgspec
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Ellipse, Rectangle
from numpy.typing import NDArray

from lfd.motion.trajectory import Trajectory
from protocol.messages import Mode
from services.offline.result import Arrangement, Course
from services.reproduction import teaching
from services.reproduction.analysis import Analysis, Context, Figure, Finding, Row
from services.reproduction.models import CONTENDERS, Contender
from services.reproduction.style import DEMONSTRATION_LINE, OBSTACLE, TRUTH, Line, drawn, panels
from services.reproduction.teaching import MODELS, Answer, Question
from services.reproduction.teaching_figures import REFINEMENT_LINE, prediction_line
from sim.tasks.particle import OBSTACLE_TRAINING, PARTICLE, X_UNIT, Y_UNIT
from sim.tasks.scene import Group

Array = NDArray[np.float64]

_FREE, _OBSTACLE = PARTICLE.variants
_COLUMNS = 3
_CONDITIONS = ((0.0, 0.0), *((y1, y2) for y1, y2 in product((-10.0, 0.0, 10.0), repeat=2) if (y1, y2) != (0.0, 0.0)))
"""s of the thesis, in its units: the one that its first model is trained at, then the other eight."""

_CORNERS = tuple((a * s1, a * s2) for a in (20.0, 15.0, 5.0) for s1, s2 in product((-1.0, 1.0), repeat=2))
_SQUARES = tuple(s for a in (20.0, 5.0) for s in product((-a, 0.0, a), repeat=2) if s != (0.0, 0.0))


_ABOUT_THE_OBSTACLE = (
    "The thesis gives the obstacle's left edge only. Here it reaches from x = 0.5 to 0.9 and up to y = 2.5, and the"
    " operator leads the particle over it at y = 5.5 whatever the condition. The higher that is, the fewer refinements"
    " are needed: at y = 8, over an obstacle to x = 0.8, it was four of nine with the thesis' method and one with the"
    " default model."
)


def mean_squared_error(prediction: Trajectory, place: Array) -> float:
    """Equation (25), in the thesis' units.

    Args:
        prediction: of the particle.
        place: y of the via-points, shape (2,) [m].
    """
    x, y = prediction.positions[:, 0], prediction.positions[:, 1]
    return float(np.mean(((np.interp(PARTICLE.via_x, x, y) - place) / Y_UNIT) ** 2))


def _via_points(context: Context) -> Finding:
    refined = _arranged(_CONDITIONS, _FREE)
    question = Question(PARTICLE, refined[:1], refined, refined, _arranged(_CORNERS, _FREE))
    return _finding(
        question,
        context,
        needed=4,
        generalised=len(_CORNERS),
        figures="Fig. 18",
        again="Fig. B.1",
        beyond="Fig. 19 and B.2",
    )


def _obstacle(context: Context) -> Finding:
    demonstrated = _arranged(OBSTACLE_TRAINING / Y_UNIT, _FREE)
    refined = _arranged(_CONDITIONS, _OBSTACLE)
    question = Question(PARTICLE, demonstrated, refined, refined, _arranged(_SQUARES, _OBSTACLE))
    found = _finding(
        question,
        context,
        needed=9,
        generalised=len(_SQUARES) - 2,
        figures="Fig. 20",
        again="Fig. B.4",
        beyond="Fig. 21, B.5",
    )
    return msgspec.structs.replace(found, notes=(_ABOUT_THE_OBSTACLE, *found.notes))


def _arranged(conditions: Iterable[Sequence[float]], variant: str) -> tuple[Arrangement, ...]:
    """Conditions in the thesis' units."""
    return tuple(Arrangement(variant, condition=(Y_UNIT * y1, Y_UNIT * y2)) for y1, y2 in conditions)


def _finding(
    question: Question, context: Context, *, needed: int, generalised: int, figures: str, again: str, beyond: str
) -> Finding:
    answer = teaching.answered(question, context)
    return Finding(
        teaching.holds(answer, needed),
        teaching.sentence(answer, needed),
        (
            *teaching.rows(answer, needed),
            Row(
                f"conditions beyond them that were reached, of {len(question.beyond)}",
                "",
                generalised,
                *map(teaching.successes, answer.beyond),
            ),
            Row("largest mean squared error in the second round (eq. 25)", "", 0.0, *_largest_errors(answer)),
        ),
        (
            _error_figure(answer),
            *_first_rounds(answer, figures),
            _second_round(answer, again),
            _beyond_figure(answer, beyond),
        ),
        (
            "Conditions are y of the via-points in the thesis' units, 0.01 m each. A via-point counts as passed within"
            f" {PARTICLE.tolerance / Y_UNIT:g} unit; the thesis judges by eye. Demonstrated were"
            f" {', '.join(_named(one) for one in question.demonstrated)}, without an obstacle; Algorithm 1 went through"
            f" {', '.join(_named(one) for one in question.refined)} in this order, which the thesis does not tell.",
            *teaching.notes(answer),
            *(_missed(kind, courses) for kind, courses in zip(CONTENDERS, answer.beyond, strict=True)),
        ),
    )


def _largest_errors(answer: Answer) -> list[float]:
    return [max(_first_error(course) for course in rehearsed.second) for rehearsed in answer.of_kinds]


def _first_error(course: Course) -> float:
    return mean_squared_error(course.attempts[0].prediction, course.arrangement.place)


def _named(arrangement: Arrangement) -> str:
    return f"[{', '.join(f'{value:g}' for value in (arrangement.place / Y_UNIT).round(6))}]"


def _missed(kind: Contender, courses: Sequence[Course]) -> str:
    failed = [f"{_named(one.arrangement)}: {one.attempts[0].failure}" for one in courses if not one.success]
    return f"Beyond them the {kind.label} failed under {'; '.join(failed) or 'none'}."


def _error_figure(answer: Answer) -> Figure:
    canvas, (axes,) = panels([""], height=2.3)
    for kind, rehearsed in zip(CONTENDERS, answer.of_kinds, strict=True):
        errors = [_first_error(course) for course in rehearsed.first]
        axes.plot(range(1, len(errors) + 1), errors, marker="o", ms=4.0, **kind.line(f"{kind.label}: at first"))
        again = [_first_error(course) for course in rehearsed.second]
        line = Line(kind.line.color, 0.6 * kind.line.linewidth, (0.0, (2.0, 1.5)))
        axes.plot(range(1, len(again) + 1), again, **line(f"{kind.label}: second round"))
    names = [f"{number}\n{_named(one)}" for number, one in enumerate(answer.question.refined, 1)]
    axes.set_xticks(range(1, len(names) + 1), names)
    tolerated = (PARTICLE.tolerance / Y_UNIT) ** 2
    axes.axhline(tolerated, color=TRUTH, linewidth=0.8, label="both via-points missed by the tolerance")
    axes.set(xlabel="condition", ylabel="mean squared error", yscale="log")
    caption = "Equation (25) of the prediction for each condition, before it is refined, and once all are learnt."
    return drawn(canvas, "error", caption)


def _first_rounds(answer: Answer, reference: str) -> list[Figure]:
    titles = [f"{number}: {_named(one)}" for number, one in enumerate(answer.question.refined, 1)]
    made = []
    for kind, model, rehearsed in zip(CONTENDERS, MODELS, answer.of_kinds, strict=True):
        canvas, panes = panels(titles, height=1.8, rows=-(-len(titles) // _COLUMNS))
        for axes, course in zip(panes, rehearsed.first, strict=True):
            _furnish(axes, course.arrangement.variant)
            _mark(axes, course.arrangement)
            # A refinement that was learnt lies under the next prediction.
            for attempt in course.attempts:
                if attempt.mode is Mode.REFINE:
                    _draw(axes, attempt.refined, replace(REFINEMENT_LINE, linewidth=3.4), "refinement")
            for attempt in course.attempts:
                if attempt.mode is not Mode.REFINE:
                    _draw(axes, attempt.prediction, *prediction_line(kind, success=attempt.success))
        caption = f"Predictions and refinements, condition by condition ({reference}): {kind.label}."
        made.append(drawn(canvas, f"first-{model}", caption))
    return made


def _second_round(answer: Answer, reference: str) -> Figure:
    canvas, panes = panels([_named(one) for one in answer.question.executed], height=1.8, rows=_COLUMNS)
    for number, axes in enumerate(panes):
        _furnish(axes, answer.question.executed[number].variant)
        _mark(axes, answer.question.executed[number])
        for kind, rehearsed in zip(CONTENDERS, answer.of_kinds, strict=True):
            course = rehearsed.second[number]
            line, label = prediction_line(kind, success=course.success)
            _draw(axes, course.attempts[0].prediction, replace(line, linewidth=kind.line.linewidth), label)
    caption = f"The same conditions once more, without teaching ({reference}): both models."
    return drawn(canvas, "second", caption)


def _beyond_figure(answer: Answer, reference: str) -> Figure:
    canvas, panes = panels([kind.label for kind in CONTENDERS], height=2.9)
    for axes, kind, courses in zip(panes, CONTENDERS, answer.beyond, strict=True):
        for demonstration in answer.demonstrations:
            _draw(axes, demonstration.trajectory, DEMONSTRATION_LINE, "demonstration")
        _furnish(axes, courses[0].arrangement.variant)
        for course in courses:
            _mark(axes, course.arrangement)
            _draw(axes, course.attempts[0].prediction, *prediction_line(kind, success=course.success))
    caption = f"Predictions for conditions that were never taught, after the second round ({reference})."
    return drawn(canvas, "beyond", caption)


def _furnish(axes: Axes, variant: str) -> None:
    """What stands in the way, in the thesis' units."""
    for box in PARTICLE.boxes(variant):
        if box.group is not Group.DETAIL:
            centre, half = (np.array(v[:2]) / (X_UNIT, Y_UNIT) for v in (box.centre, box.half_sizes))
            axes.add_patch(Rectangle(tuple(centre - half), *(2.0 * half), color=OBSTACLE, alpha=0.35, lw=0.0))
    axes.set(xlim=(-0.1, 4.1), ylim=(-24.0, 24.0), xticks=range(5), yticks=range(-20, 21, 10), xlabel="x", ylabel="y")
    axes.label_outer()


def _mark(axes: Axes, arrangement: Arrangement) -> None:
    """The via-points, as rings of the tolerance."""
    width, height = 2.0 * PARTICLE.tolerance / np.array((X_UNIT, Y_UNIT))
    for x, y in zip(np.array(PARTICLE.via_x) / X_UNIT, arrangement.place / Y_UNIT, strict=True):
        axes.add_patch(Ellipse((x, y), width, height, fill=False, edgecolor=TRUTH, linewidth=1.0, zorder=3.0))


def _draw(axes: Axes, motion: Trajectory, line: Line, label: str) -> None:
    axes.plot(motion.positions[:, 0] / X_UNIT, motion.positions[:, 1] / Y_UNIT, **line(label))


VIA_POINTS = Analysis(
    name="via-points",
    reference="Fig. 18-19, B.1-B.2",
    about="How many conditions of a 2D example have to be refined until all via-points are reached?",
    claim="After observing and adapting the prediction of four conditions, the MSE was zero for all the upcoming"
    " conditions. The conditions from -20 to +20 and -5 to +5 show that the viapoints are successfully reached.",
    run=_via_points,
)

OBSTACLE_2D = Analysis(
    name="obstacle",
    reference="Fig. 20-21, B.3-B.5",
    about="How many conditions of the 2D example have to be refined until its obstacle is avoided?",
    claim="With an obstacle each of the nine conditions needs to be adapted; after that each of them avoids it. Of the"
    " generalizations towards -20 to 20 and -5 to 5 all but two avoid it while reaching the viapoints.",
    run=_obstacle,
)
