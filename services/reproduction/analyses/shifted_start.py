"""Predictions that do not begin where the robot is (Appendix B, "Shifted initial position")."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lfd.models.model import MovementModel
from lfd.motion.demonstration import Demonstration, Situation
from services.reproduction.analysis import Analysis, Context, Figure, Finding, Holds, Row
from services.reproduction.models import CONTENDERS, THESIS
from services.reproduction.scripted import demonstrate, object_grid
from services.reproduction.style import DEMONSTRATION_LINE, Line, drawn, panels
from sim.tasks.table import TABLE

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
    shifts = {}
    for count in context.track(_COUNTS):
        models = [kind.fit(motions[:count]) for kind in CONTENDERS]
        shifts[count] = [1e3 * np.array([shift(model, s) for s in asked]) for model in models]
    few, enough = shifts[1][0].max() / 1e3, shifts[4][0].max() / 1e3
    confirmed = few > _VISIBLE > enough
    return Finding(
        Holds.YES if confirmed else Holds.DIFFERS,
        "With one or two conditions the thesis' method begins centimetres away from the gripper, with four it does not."
        " A model that is anchored to the start begins at the gripper however few there are."
        if confirmed
        else f"With one condition the shift is up to {few * 1e3:.0f} mm, with four still up to {enough * 1e3:.0f} mm."
        " A model that is anchored to the start begins at the gripper however few there are.",
        rows=tuple(
            Row(
                f"largest distance of a prediction's first point to the gripper, {_said(count)}",
                "mm",
                {1: "“shifted”", 2: "“shifted”", 3: "“not shifted”"}.get(count),
                *(float(of_kind.max()) for of_kind in shifts[count]),
            )
            for count in _COUNTS
        ),
        figures=(_predictions_figure(motions, asked), _shifts_figure(motions, asked, shifts)),
        notes=(
            f"Objects stand at {_GRID} times {_GRID} places all over the table's region; the models know the motions to"
            " one, two, three or four of its corners. The thesis found three conditions to be enough on its table.",
        ),
    )


def _said(count: int) -> str:
    return "one condition" if count == 1 else f"{count} conditions"


def _predictions_figure(motions: list[Demonstration], asked: list[Situation]) -> Figure:
    canvas, panes = panels(["one condition", "two conditions"], height=3.2)
    for axes, count in zip(panes, (1, 2), strict=True):
        for motion in motions[:count]:
            p = motion.trajectory.positions
            axes.plot(p[:, 1], p[:, 0], **DEMONSTRATION_LINE("demonstrations"))
        for kind in CONTENDERS:
            model = kind.fit(motions[:count])
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


def _shifts_figure(motions: list[Demonstration], asked: list[Situation], shifts: dict[int, list[Array]]) -> Figure:
    canvas, (axes,) = panels([""], height=2.6)
    for count, shade in zip(_COUNTS, _SHADES, strict=True):
        taught = np.array([m.condition for m in motions[:count]])
        away = [1e3 * float(np.linalg.norm(taught - s.condition, axis=1).min()) for s in asked]
        axes.plot(away, shifts[count][0], "o", ms=3.5, color=shade, label=f"{THESIS.label}, {_said(count)}")
    axes.plot(away, shifts[_COUNTS[-1]][1], "o", ms=3.5, color=CONTENDERS[1].line.color, label=CONTENDERS[1].label)
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
)
