"""Objects in different planes and different initial poses, from scripted demonstrations (Appendix A)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lfd.models.model import MovementModel
from lfd.models.promp import PrompOptions
from lfd.motion.demonstration import Demonstration, relative_to_origin, to_base
from lfd.motion.resampling import resample
from services.reproduction.analysis import Analysis, Claim, Context, Figure, Finding, Relation, Row, Source
from services.reproduction.functions import rms
from services.reproduction.models import CONTENDERS, DEFAULT, FINE, THESIS, Contender
from services.reproduction.scripted import demonstrate
from services.reproduction.style import DEMONSTRATION_LINE, TRUE_LINE, Line, drawn, panels
from sim.tasks import TABLE

Array = NDArray[np.float64]

_HEIGHTS = (0.0, 0.12)  # [m] of the taught planes above the table's
_BETWEEN = 0.06  # [m] of the plane that is asked for, never taught
_STARTS = np.array([[0.0, 0.0, 0.0], [0.04, -0.06, 0.04], [-0.05, 0.05, 0.08]])  # [m] from the scene's own
_NEW_START = np.array([-0.02, -0.03, 0.05])  # [m] from the scene's own, never taught


@dataclass(frozen=True, eq=False)
class Question:
    """A group of situations that a model is asked about.

    Attributes:
        name: for the table.
        motions: as a person with a steady hand would make them.
    """

    name: str
    motions: tuple[Demonstration, ...]


@dataclass(frozen=True)
class Answer:
    """How well a model did over a question's situations.

    Attributes:
        error: root mean square distance to the person's motion at the same share of the time [m].
        end: mean distance between the last points [m].
        start: mean distance between the first points [m].
    """

    error: float
    end: float
    start: float


def answer(model: MovementModel, question: Question) -> Answer:
    """Ask a model about every situation of a question."""
    predictions = [model.predict(m.situation, m.trajectory.n_points) for m in question.motions]
    pairs = list(zip(predictions, question.motions, strict=True))
    off = np.array([p.trajectory.positions - m.trajectory.positions for p, m in pairs])
    distances = np.linalg.norm(off, axis=2)
    return Answer(
        error=rms(distances),
        end=float(distances[:, -1].mean()),
        start=float(distances[:, 0].mean()),
    )


def _planes(context: Context) -> Finding:
    rng = context.rng()
    taught, questions = _demonstrations(rng), _questions()
    models = {kind: kind.fit(taught) for kind in CONTENDERS}
    answers = {
        question: {kind: answer(model, question) for kind, model in models.items()}
        for question in context.track(questions)
    }
    rows, claims = [], []
    own = {question: unsteadiness(question, rng) for question in questions}
    for question, of_kinds in answers.items():
        rows += [
            Row(
                f"{question.name}: RMSE of the path",
                {kind.name: 1e3 * a.error for kind, a in of_kinds.items()},
                "mm",
                thesis="“generalizes”",
                headline=True,
            ),
            Row("its start is off by", {kind.name: 1e3 * a.start for kind, a in of_kinds.items()}, "mm"),
        ]
        claims.append(
            Claim(
                Source.THESIS,
                f"The model generalises towards {question.name}: it comes as near to a steady hand as the person does.",
                "RMSE",
                1e3 * of_kinds[THESIS].error,
                Relation.AT_MOST,
                1e3 * own[question],
                against="the person's own",
                unit="mm",
            )
        )
        claims.append(
            Claim(
                Source.RETOUCH,
                f"For {question.name} the default model comes nearer to a steady hand than the thesis' model with the"
                " same start anchor and resolution.",
                "RMSE",
                1e3 * of_kinds[DEFAULT].error,
                Relation.BELOW,
                1e3 * of_kinds[FINE].error,
                against=FINE.label,
                unit="mm",
            )
        )
    return Finding(
        tuple(claims),
        tuple(rows),
        context.drawn(
            lambda: (_preparation_figure(taught), _above_figure(models, questions[1]), _side_figure(models, questions))
        ),
        (
            f"A general model of {len(taught)} scripted motions: objects at the corners of the table's region in two"
            " planes 12 cm apart, each reached from one of three initial positions. They are steered along the scene's"
            " corridor without a simulator, so the arm is taken to follow; collisions are judged in the analyses of the"
            " robot, not here. The measure is what a person with a steady hand would do.",
        ),
    )


def unsteadiness(question: Question, rng: np.random.Generator) -> float:
    """How far a person is from a steady hand in a question's situations: root mean square distance [m]."""
    off = []
    for motion in question.motions:
        height = float(motion.origin[2]) - TABLE.region.lower[2]
        below = motion.origin - np.array([0.0, 0.0, height])
        made = _reach(below, height, motion.trajectory.positions[0], rng)
        off.append(made.trajectory.positions - motion.trajectory.positions)
    return rms(np.linalg.norm(np.array(off), axis=2))


def _demonstrations(rng: np.random.Generator) -> list[Demonstration]:
    motions = []
    for height in _HEIGHTS:
        for i, position in enumerate(TABLE.training_positions):
            start = TABLE.start.position + _STARTS[i % len(_STARTS)]
            motions.append(_reach(position, height, start, rng))
    return motions


def _questions() -> list[Question]:
    (x0, y0, _), (x1, y1, z) = TABLE.region.lower, TABLE.region.upper
    places = [np.array([x, y, z]) for x in np.linspace(x0, x1, 3)[1:2] for y in np.linspace(y0, y1, 5)[1:4]]
    places += [np.array([x, y, z]) for x in (x0 + 0.02, x1 - 0.02) for y in (y0 + 0.06, y1 - 0.06)]
    start = TABLE.start.position

    def ask(name: str, height: float, begin: Array) -> Question:
        return Question(name, tuple(_reach(p, height, begin) for p in places))

    return [
        ask("new objects in a plane that was taught", _HEIGHTS[0], start),
        ask("new objects in a plane between", _BETWEEN, start),
        ask("new objects from a new initial position", _HEIGHTS[1], start + _NEW_START),
    ]


def _reach(position: Array, height: float, start: Array, rng: np.random.Generator | None = None) -> Demonstration:
    """A motion on a table that stands higher: the object and the way to it are raised, the start is not."""
    up = np.array([0.0, 0.0, height])
    below = demonstrate(TABLE, position, rng, start=start - up)
    return Demonstration.reaching(to_base(below.trajectory, up), position + up)


def _preparation_figure(taught: list[Demonstration]) -> Figure:
    n = PrompOptions().samples
    steps = {
        "raw": [m.trajectory for m in taught],
        f"resampled to {n} points": [resample(m.trajectory, n) for m in taught],
        "relative to the object": [resample(relative_to_origin(m.trajectory, m.origin), n) for m in taught],
    }
    canvas, panes = panels([*steps, "", "", ""], rows=2, height=1.9)
    for column, trajectories in enumerate(steps.values()):
        for axis, axes in ((1, panes[column]), (2, panes[column + 3])):
            for trajectory in trajectories:
                line = Line(DEMONSTRATION_LINE.color, 1.0)
                marker = "." if trajectory.n_points == n else ""
                axes.plot(trajectory.times, trajectory.positions[:, axis], marker=marker, **line("demonstrations"))
        panes[column + 3].set_xlabel("time [s]")
    panes[0].set_ylabel("y [m]")
    panes[3].set_ylabel("z [m]")
    return drawn(canvas, "preparation", "The demonstrations on their way into the model (Fig. A.13 to A.15).")


def _above_figure(models: Mapping[Contender, MovementModel], question: Question) -> Figure:
    canvas, panes = panels([kind.label for kind in models], height=2.6, rows=2)
    for axes, (kind, model) in zip(panes, models.items(), strict=True):
        for motion in question.motions:
            p = model.predict(motion.situation).trajectory.positions
            axes.plot(p[:, 1], p[:, 0], **Line(kind.line.color, 1.4)(kind.label))
            real = motion.trajectory.positions
            axes.plot(real[:, 1], real[:, 0], **TRUE_LINE("a steady hand"))
            axes.plot(motion.origin[1], motion.origin[0], "s", color="#3c6e57", ms=4, label="object")
        axes.set(xlabel="y [m]", ylabel="x [m]", aspect="equal")
        axes.sharey(panes[0])
        axes.label_outer()
    caption = f"From above: predictions for {question.name} (Fig. A.16)."
    return drawn(canvas, "above", caption)


def _side_figure(models: Mapping[Contender, MovementModel], questions: list[Question]) -> Figure:
    canvas, panes = panels([q.name.removeprefix("new objects ") for q in questions], height=2.6)
    for axes, question in zip(panes, questions, strict=True):
        for motion in question.motions[:3]:
            for kind, model in models.items():
                p = model.predict(motion.situation).trajectory.positions
                axes.plot(p[:, 1], p[:, 2], **Line(kind.line.color, kind.line.linewidth * 0.7)(kind.label))
            real = motion.trajectory.positions
            axes.plot(real[:, 1], real[:, 2], **TRUE_LINE("a steady hand"))
            axes.plot(motion.origin[1], motion.origin[2], "s", color="#3c6e57", ms=4, label="object")
        axes.set(xlabel="y [m]")
        axes.sharey(panes[0])
    panes[0].set_ylabel("z [m]")
    return drawn(canvas, "side", "The same from the side, for three objects of each question.")


PLANES = Analysis(
    name="planes",
    reference="Fig. A.13-A.16",
    about="Does a general model reach objects in different planes, from different initial poses?",
    claim="Demonstrations have been provided for different initial poses as well as different object positions; the"
    " generalization towards different object positions in different planes is illustrated, in addition to different"
    " initial end effector poses.",
    run=_planes,
    seconds=1.2,
)
