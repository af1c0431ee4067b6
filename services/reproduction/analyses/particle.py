"""The 2D example: via-points that a particle is to pass through, without and with an obstacle in the way."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import product
from typing import TYPE_CHECKING

import msgspec
import numpy as np
from numpy.typing import NDArray

from lfd.motion.trajectory import Trajectory
from protocol.messages import Mode
from services.offline.result import Arrangement, Course
from services.reproduction import teaching
from services.reproduction.analysis import Analysis, Claim, Context, Figure, Finding, Relation, Row, Source
from services.reproduction.models import CONTENDERS, SHOWN, THESIS, Contender
from services.reproduction.style import DEMONSTRATION_LINE, OBSTACLE, TRUTH, Line, drawn, panels
from services.reproduction.teaching import Answer, Question
from services.reproduction.teaching_figures import REFINEMENT_LINE, prediction_line
from sim.tasks.particle import OBSTACLE_TRAINING, PARTICLE, X_UNIT, Y_UNIT
from sim.tasks.scene import Group

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]

_FREE, _OBSTACLE = PARTICLE.variants
_COLUMNS = 3
_NEEDED_FREE = 4  # of the thesis, without the obstacle
_TOLERATED = (PARTICLE.tolerance / Y_UNIT) ** 2  # mean squared error of passing both via-points at the tolerance
_CONDITIONS = ((0.0, 0.0), *((y1, y2) for y1, y2 in product((-10.0, 0.0, 10.0), repeat=2) if (y1, y2) != (0.0, 0.0)))
"""s of the thesis, in its units: the one that its first model is trained at, then the other eight."""

_CORNERS = tuple((a * s1, a * s2) for a in (20.0, 15.0, 5.0) for s1, s2 in product((-1.0, 1.0), repeat=2))
_SQUARES = tuple(s for a in (20.0, 5.0) for s in product((-a, 0.0, a), repeat=2) if s != (0.0, 0.0))


_ABOUT_THE_OBSTACLE = (
    "The thesis gives the obstacle's left edge only. Here it reaches from x = 0.5 to 0.9 and up to y = 2.5, and the"
    " operator leads the particle over it at y = 5.5 whatever the condition: how many refinements are needed depends on"
    " how high that is."
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
    answer = teaching.answered(Question(PARTICLE, refined[:1], refined, refined, _arranged(_CORNERS, _FREE)), context)
    upcoming = answer.first(THESIS)[_NEEDED_FREE:]
    thesis = (
        teaching.few_needed(answer, "Four conditions have to be observed and adapted.", _NEEDED_FREE),
        Claim(
            Source.THESIS,
            "The mean squared error is zero for all the upcoming conditions: the via-points are passed within the"
            " tolerance.",
            "largest mean squared error of them",
            max(_first_error(course) for course in upcoming),
            Relation.AT_MOST,
            _TOLERATED,
        ),
        _generalises(
            answer,
            "For conditions from -20 to +20 and -5 to +5 the via-points are successfully reached.",
            len(_CORNERS),
        ),
    )
    return _finding(
        answer, context, thesis, _NEEDED_FREE, len(_CORNERS), references=("Fig. 18", "Fig. B.1", "Fig. 19 and B.2")
    )


def _obstacle(context: Context) -> Finding:
    demonstrated = _arranged(OBSTACLE_TRAINING / Y_UNIT, _FREE)
    refined = _arranged(_CONDITIONS, _OBSTACLE)
    answer = teaching.answered(
        Question(PARTICLE, demonstrated, refined, refined, _arranged(_SQUARES, _OBSTACLE)), context
    )
    all_nine = len(_CONDITIONS)
    thesis = (
        Claim(
            Source.THESIS,
            "Each of the nine conditions needs to be adapted.",
            "conditions refined",
            teaching.needed(answer.first(THESIS)),
            Relation.AT_LEAST,
            all_nine,
        ),
        teaching.reached_again(answer, "After that each of them avoids the obstacle."),
        _generalises(answer, "All but two generalisations avoid it while reaching the via-points.", len(_SQUARES) - 2),
    )
    found = _finding(
        answer, context, thesis, all_nine, len(_SQUARES) - 2, references=("Fig. 20", "Fig. B.4", "Fig. 21, B.5")
    )
    return msgspec.structs.replace(found, notes=(_ABOUT_THE_OBSTACLE, *found.notes))


def _generalises(answer: Answer, sentence: str, least: int) -> Claim:
    reached = teaching.successes(answer.beyond(THESIS))
    return Claim(Source.THESIS, sentence, "conditions beyond that are reached", reached, Relation.AT_LEAST, least)


def _arranged(conditions: Iterable[Sequence[float]], variant: str) -> tuple[Arrangement, ...]:
    """Conditions in the thesis' units."""
    return tuple(Arrangement(variant, condition=(Y_UNIT * y1, Y_UNIT * y2)) for y1, y2 in conditions)


def _finding(
    answer: Answer,
    context: Context,
    thesis: Sequence[Claim],
    needed: int,
    generalised: int,
    *,
    references: tuple[str, str, str],
) -> Finding:
    """Both analyses alike; the references are those of the first round, the second and beyond."""
    question = answer.question
    return Finding(
        teaching.claims(answer, thesis),
        (
            *teaching.rows(answer, needed),
            Row(
                "conditions beyond them that were reached",
                answer.values(lambda one: teaching.successes(answer.beyond(one))),
                thesis=generalised,
                total=len(question.beyond),
                headline=True,
            ),
            Row(
                "largest mean squared error in the second round (eq. 25)",
                answer.values(lambda one: max(_first_error(course) for course in answer.second(one))),
                thesis=0.0,
            ),
        ),
        context.drawn(
            lambda: (
                _error_figure(answer),
                *_first_rounds(answer, references[0]),
                _second_round(answer, references[1]),
                _beyond_figure(answer, references[2]),
            )
        ),
        (
            "Conditions are y of the via-points in the thesis' units, 0.01 m each. A via-point counts as passed within"
            f" {PARTICLE.tolerance / Y_UNIT:g} unit; the thesis judges by eye. Demonstrated were"
            f" {', '.join(_named(one) for one in question.demonstrated)}, without an obstacle; Algorithm 1 went through"
            f" {', '.join(_named(one) for one in question.refined)} in this order, which the thesis does not tell.",
            *teaching.notes(answer),
            *(_missed(kind, answer.beyond(kind)) for kind in SHOWN),
        ),
    )


def _first_error(course: Course) -> float:
    return mean_squared_error(course.attempts[0].prediction, course.arrangement.place)


def _named(arrangement: Arrangement) -> str:
    return f"[{', '.join(f'{value:g}' for value in (arrangement.place / Y_UNIT).round(6))}]"


def _missed(kind: Contender, courses: Sequence[Course]) -> str:
    failed = [f"{_named(one.arrangement)}: {one.attempts[0].failure}" for one in courses if not one.success]
    return f"Beyond them the first person's {kind.label} failed under {'; '.join(failed) or 'none'}."


def _error_figure(answer: Answer) -> Figure:
    canvas, (axes,) = panels([""], height=2.3)
    for kind in CONTENDERS:
        errors = [_first_error(course) for course in answer.first(kind)]
        axes.plot(range(1, len(errors) + 1), errors, marker="o", ms=4.0, **kind.line(f"{kind.label}: at first"))
        again = [_first_error(course) for course in answer.second(kind)]
        line = Line(kind.line.color, 0.6 * kind.line.linewidth, (0.0, (2.0, 1.5)))
        axes.plot(range(1, len(again) + 1), again, **line(f"{kind.label}: second round"))
    names = [f"{number}\n{_named(one)}" for number, one in enumerate(answer.question.refined, 1)]
    axes.set_xticks(range(1, len(names) + 1), names)
    axes.axhline(_TOLERATED, color=TRUTH, linewidth=0.8, label="both via-points missed by the tolerance")
    axes.set(xlabel="condition", ylabel="mean squared error", yscale="log")
    caption = "Equation (25) of the prediction for each condition, before it is refined, and once all are learnt."
    return drawn(canvas, "error", caption)


def _first_rounds(answer: Answer, reference: str) -> list[Figure]:
    titles = [f"{number}: {_named(one)}" for number, one in enumerate(answer.question.refined, 1)]
    made = []
    for kind in SHOWN:
        canvas, panes = panels(titles, height=1.8, rows=-(-len(titles) // _COLUMNS))
        for axes, course in zip(panes, answer.first(kind), strict=True):
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
        made.append(drawn(canvas, f"first-{kind.name}", caption))
    return made


def _second_round(answer: Answer, reference: str) -> Figure:
    canvas, panes = panels([_named(one) for one in answer.question.executed], height=1.8, rows=_COLUMNS)
    for number, axes in enumerate(panes):
        _furnish(axes, answer.question.executed[number].variant)
        _mark(axes, answer.question.executed[number])
        for kind in CONTENDERS:
            course = answer.second(kind)[number]
            line, label = prediction_line(kind, success=course.success)
            _draw(axes, course.attempts[0].prediction, replace(line, linewidth=kind.line.linewidth), label)
    caption = f"The same conditions once more, without teaching ({reference})."
    return drawn(canvas, "second", caption)


def _beyond_figure(answer: Answer, reference: str) -> Figure:
    canvas, panes = panels([kind.label for kind in CONTENDERS], height=2.5, rows=2)
    for axes, kind in zip(panes, CONTENDERS, strict=True):
        courses = answer.beyond(kind)
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
    from matplotlib.patches import Rectangle  # noqa: PLC0415 - see `style`

    for box in PARTICLE.boxes(variant):
        if box.group is not Group.DETAIL:
            centre, half = (np.array(v[:2]) / (X_UNIT, Y_UNIT) for v in (box.centre, box.half_sizes))
            axes.add_patch(Rectangle(tuple(centre - half), *(2.0 * half), color=OBSTACLE, alpha=0.35, lw=0.0))
    axes.set(xlim=(-0.1, 4.1), ylim=(-24.0, 24.0), xticks=range(5), yticks=range(-20, 21, 10), xlabel="x", ylabel="y")
    axes.label_outer()


def _mark(axes: Axes, arrangement: Arrangement) -> None:
    """The via-points, as rings of the tolerance."""
    from matplotlib.patches import Ellipse  # noqa: PLC0415 - see `style`

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
    seconds=75.0,
)

OBSTACLE_2D = Analysis(
    name="obstacle",
    reference="Fig. 20-21, B.3-B.5",
    about="How many conditions of the 2D example have to be refined until its obstacle is avoided?",
    claim="With an obstacle each of the nine conditions needs to be adapted; after that each of them avoids it. Of the"
    " generalizations towards -20 to 20 and -5 to 5 all but two avoid it while reaching the viapoints.",
    run=_obstacle,
    seconds=95.0,
)
