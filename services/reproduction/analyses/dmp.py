"""Dynamic movement primitives, which the thesis tried first (Appendix B)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lfd.models.dmp import DMP
from lfd.motion.demonstration import Demonstration
from lfd.motion.trajectory import Trajectory
from services.offline.steering import DURATION_S
from services.reproduction.analysis import Analysis, Context, Figure, Finding, Holds, Row
from services.reproduction.functions import rms
from services.reproduction.models import DEFAULT, THESIS
from services.reproduction.scripted import demonstrate, object_grid, reaches, steady_motions
from services.reproduction.style import CONDITIONED, DEMONSTRATION_LINE, TRUE_LINE, Line, drawn, panels
from sim.tasks.table import TABLE

Array = NDArray[np.float64]

_GRID = 5
_AT_GOAL = 1e-3  # [m]


def reproduced(primitive: DMP, motion: Demonstration, goal: Trajectory) -> Trajectory:
    """The primitive from a motion's own start to the last pose of another trajectory."""
    start, n = motion.trajectory, motion.trajectory.n_points
    return primitive.reproduce(
        (start.positions[0], start.orientations[0]), (goal.positions[-1], goal.orientations[-1]), DURATION_S, n
    )


def _dmp(context: Context) -> Finding:
    rng = context.rng()
    taught = [demonstrate(TABLE, position, rng) for position in TABLE.training_positions]
    motions = steady_motions(TABLE, object_grid(TABLE, _GRID))
    primitive = DMP.fit(taught[0].trajectory)
    led = [reproduced(primitive, m, m.trajectory) for m in motions]
    hardcoded = [reproduced(primitive, m, taught[0].trajectory) for m in motions]
    models = {kind: kind.fit(taught) for kind in (THESIS, DEFAULT)}
    predicted = {
        kind: [model.predict(m.situation, m.trajectory.n_points).trajectory for m in motions]
        for kind, model in models.items()
    }
    context.advance(0.7)
    off_goal = max(_end_error(t, m) for t, m in zip(led, motions, strict=True))
    found, missed = _reached(led, motions), _reached(hardcoded, motions)
    confirmed = off_goal < _AT_GOAL and found == 100.0 and missed < 50.0
    return Finding(
        Holds.YES if confirmed else Holds.DIFFERS,
        "A DMP of one motion ends at every goal that it is given, and misses the object where the goal that it was"
        " given is not where the object is."
        if confirmed
        else f"With the goal given {found:.0f} % of the objects are reached, with a hard-coded one {missed:.0f} %.",
        rows=(
            Row(
                "largest distance of the end to the goal that was given (method: DMP)",
                "mm",
                "“converges”",
                1e3 * off_goal,
            ),
            Row(
                "objects reached, each with its goal given (method: DMP)",
                "%",
                None,
                found,
                _reached(predicted[DEFAULT], motions),
            ),
            Row("objects reached with the goal hard-coded (method: DMP)", "%", "“will fail”", missed),
            Row(
                "RMSE of the path, each with its goal given (method: DMP)",
                "mm",
                None,
                1e3 * _path_error(led, motions),
                1e3 * _path_error(predicted[DEFAULT], motions),
            ),
            Row("the same by the conditioned ProMP", "mm", None, 1e3 * _path_error(predicted[THESIS], motions)),
        ),
        figures=(_figure(taught[0], motions, led, hardcoded),),
        notes=(
            f"The primitive knows one motion over the table, the two models those to the {len(taught)} corners of its"
            f" region; objects stand at {_GRID} times {_GRID} places. A goal that is given is the whole pose at which a"
            " person would end, which the models are not told. The measure is what a person with a steady hand would"
            " do.",
        ),
    )


def _end_error(trajectory: Trajectory, motion: Demonstration) -> float:
    return float(np.linalg.norm(trajectory.positions[-1] - motion.trajectory.positions[-1]))


def _reached(trajectories: list[Trajectory], motions: list[Demonstration]) -> float:
    """Share of the objects that are within reach at the end [%]."""
    pairs = zip(trajectories, motions, strict=True)
    return 100.0 * float(np.mean([reaches(t, m.origin, TABLE) for t, m in pairs]))


def _path_error(trajectories: list[Trajectory], motions: list[Demonstration]) -> float:
    """Root mean square distance to the motions [m]."""
    off = np.array([t.positions - m.trajectory.positions for t, m in zip(trajectories, motions, strict=True)])
    return rms(np.linalg.norm(off, axis=2))


def _figure(
    taught: Demonstration, motions: list[Demonstration], led: list[Trajectory], hardcoded: list[Trajectory]
) -> Figure:
    canvas, panes = panels(["goal given", "goal hard-coded"], height=3.1)
    chosen = (_GRID - 1, _GRID * _GRID - 1)
    for axes, trajectories in zip(panes, (led, hardcoded), strict=True):
        demonstrated = taught.trajectory.positions
        axes.plot(demonstrated[:, 1], demonstrated[:, 0], **DEMONSTRATION_LINE("the one demonstration"))
        for i in chosen:
            p, real = trajectories[i].positions, motions[i].trajectory.positions
            axes.plot(p[:, 1], p[:, 0], **Line(CONDITIONED, 1.6)("DMP"))
            axes.plot(real[:, 1], real[:, 0], **TRUE_LINE("a steady hand"))
            axes.plot(motions[i].origin[1], motions[i].origin[0], "s", color="#3c6e57", ms=4, label="object")
        axes.set(xlabel="y [m]", aspect="equal")
    panes[0].set_ylabel("x [m]")
    return drawn(canvas, "predictions", "Two predictions of a DMP, from above (Fig. B.22).")


DYNAMIC_MOVEMENT_PRIMITIVES = Analysis(
    name="dmp",
    reference="Fig. B.22",
    about="What does a dynamic movement primitive predict?",
    claim="One demonstration is enough, and the motion is guaranteed to converge to the goal. The goal is hardcoded;"
    " it can be extracted by an object detection module, but this always requires the object to be completely known,"
    " and DMP will fail otherwise.",
    run=_dmp,
)
