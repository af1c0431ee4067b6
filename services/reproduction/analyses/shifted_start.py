"""Predictions that do not begin where the robot is (Appendix B, "Shifted initial position")."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from lfd.models.model import MovementModel
from lfd.motion.demonstration import Demonstration, Situation
from services.reproduction.analysis import Analysis, Claim, Context, Figure, Finding, Relation, Row, Source
from services.reproduction.functions import rms
from services.reproduction.models import ANCHORED, CONTENDERS, DEFAULT, FINE, THESIS, Contender
from services.reproduction.scripted import demonstrate, object_grid, steady_motions
from services.reproduction.style import DEMONSTRATION_LINE, Line, drawn, panels
from sim.tasks import TABLE

Array = NDArray[np.float64]

_COUNTS = (1, 2, 3, 4)
_ORDER = (0, 3, 1, 2)  # of the training positions: two of them are opposite corners
_GRID = 7  # object positions along each side of the scene's region
_VISIBLE = 0.01  # [m]
_SHADES = ("#f4a582", "#e07b4a", "#d55e00", "#8c3d00")


def shift(model: MovementModel, situation: Situation) -> float:
    """Distance from a prediction's first point to where the end effector is [m]."""
    first = model.predict(situation).trajectory.positions[0]
    return float(np.linalg.norm(first - situation.start_position))


def _shifted_start(context: Context) -> Finding:
    rng = context.rng()
    motions = [demonstrate(TABLE, TABLE.training_positions[i], rng) for i in _ORDER]
    start = motions[0].situation
    asked = [Situation.reaching(p, start.start_position, start.start_orientation) for p in object_grid(TABLE, _GRID)]
    steady = steady_motions(TABLE, object_grid(TABLE, _GRID))
    models = {count: {kind: kind.fit(motions[:count]) for kind in CONTENDERS} for count in _COUNTS}
    errors = {count: {k: 1e3 * _error(model, steady) for k, model in models[count].items()} for count in _COUNTS}
    shifts = {
        count: {kind: 1e3 * np.array([shift(model, s) for s in asked]) for kind, model in models[count].items()}
        for count in context.track(_COUNTS)
    }
    return Finding(
        _claims(shifts, errors),
        (
            *(
                Row(
                    f"largest distance of a prediction's first point to the gripper, {_said(count)}",
                    {kind.name: float(of_kind.max()) for kind, of_kind in shifts[count].items()},
                    "mm",
                    thesis={1: "“shifted”", 2: "“shifted”", 3: "“not shifted”"}.get(count),
                    headline=count in (2, 3),
                )
                for count in _COUNTS
            ),
            *(
                Row(f"RMSE of the path, {_said(count)}", {k.name: value for k, value in errors[count].items()}, "mm")
                for count in _COUNTS
            ),
        ),
        context.drawn(lambda: (_predictions_figure(models, motions, asked), _shifts_figure(motions, asked, shifts))),
        (
            f"Objects stand at {_GRID} times {_GRID} places all over the table's region; the models know the motions to"
            " one, two, three or four of its corners. The thesis found three conditions to be enough on its table."
            " Whoever is anchored begins at the gripper whatever it knows: what that is worth shows on the way, beside"
            " what a person with a steady hand would do.",
        ),
    )


def _error(model: MovementModel, steady: Sequence[Demonstration]) -> float:
    """Root mean square distance of the predictions to what a steady hand would do [m]."""
    n = steady[0].trajectory.n_points
    off = [model.predict(m.situation, n).trajectory.positions - m.trajectory.positions for m in steady]
    return rms(np.linalg.norm(np.array(off), axis=2))


def _claims(
    shifts: Mapping[int, Mapping[Contender, Array]], errors: Mapping[int, Mapping[Contender, float]]
) -> tuple[Claim, ...]:
    few, enough = 2, 3
    visible = 1e3 * _VISIBLE
    return (
        Claim(
            Source.THESIS,
            "With too few demonstrations, of two conditions, the start of the prediction is shifted.",
            "largest shift",
            float(shifts[few][THESIS].max()),
            Relation.ABOVE,
            visible,
            unit="mm",
        ),
        Claim(
            Source.THESIS,
            "With demonstrations of three conditions the start is not shifted.",
            "largest shift",
            float(shifts[enough][THESIS].max()),
            Relation.BELOW,
            visible,
            unit="mm",
        ),
        Claim(
            Source.RETOUCH,
            "The start anchor helps beyond the start: with two conditions it brings the thesis' model nearer to a"
            " steady hand over the whole way.",
            "RMSE of the path",
            errors[few][ANCHORED],
            Relation.BELOW,
            errors[few][THESIS],
            against=THESIS.label,
            unit="mm",
        ),
        Claim(
            Source.RETOUCH,
            "With two conditions the default model comes nearer to a steady hand than the thesis' model does with the"
            " same start anchor and resolution.",
            "RMSE of the path",
            errors[few][DEFAULT],
            Relation.BELOW,
            errors[few][FINE],
            against=FINE.label,
            unit="mm",
        ),
    )


def _said(count: int) -> str:
    return "one condition" if count == 1 else f"{count} conditions"


def _predictions_figure(
    models: Mapping[int, Mapping[Contender, MovementModel]], motions: list[Demonstration], asked: list[Situation]
) -> Figure:
    canvas, panes = panels(["one condition", "two conditions"], height=3.2)
    for axes, count in zip(panes, (1, 2), strict=True):
        for motion in motions[:count]:
            p = motion.trajectory.positions
            axes.plot(p[:, 1], p[:, 0], **DEMONSTRATION_LINE("demonstrations"))
        for kind, model in models[count].items():
            line = Line(kind.line.color, 1.2)
            for situation in (asked[_GRID - 1], asked[-_GRID]):
                p = model.predict(situation).trajectory.positions
                axes.plot(p[:, 1], p[:, 0], **line(kind.label))
                axes.plot(p[0, 1], p[0, 0], "o", color=kind.line.color, ms=4)
        gripper = motions[0].trajectory.positions[0]
        axes.plot(gripper[1], gripper[0], "k+", ms=11, mew=1.6, label="gripper")
        axes.set(xlabel="y [m]", aspect="equal")
    panes[0].set_ylabel("x [m]")
    return drawn(
        canvas, "predictions", "Predictions for objects at two other corners, from above; dots are where they begin."
    )


def _shifts_figure(
    motions: list[Demonstration], asked: list[Situation], shifts: Mapping[int, Mapping[Contender, Array]]
) -> Figure:
    canvas, (axes,) = panels([""], height=2.6)
    for count, shade in zip(_COUNTS, _SHADES, strict=True):
        taught = np.array([m.condition for m in motions[:count]])
        away = [1e3 * float(np.linalg.norm(taught - s.condition, axis=1).min()) for s in asked]
        axes.plot(away, shifts[count][THESIS], "o", ms=3.5, color=shade, label=f"{THESIS.label}, {_said(count)}")
    axes.set(xlabel="distance to the nearest condition taught [mm]", ylabel="shift of the start [mm]")
    return drawn(canvas, "shifts", "Shift of the prediction's start over how far the object is from those taught.")


SHIFTED_START = Analysis(
    name="shifted-start",
    reference="Fig. B.20",
    about="Does a prediction begin where the gripper is?",
    claim="When too little initial demonstrations were used to train the model, it has to extrapolate too much, and the"
    " initial position of the prediction is shifted. This is prevented by using enough initial demonstrations for"
    " different conditions.",
    run=_shifted_start,
    seconds=1.0,
)
