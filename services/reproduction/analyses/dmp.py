"""Dynamic movement primitives, which the thesis tried first (Appendix B), and what the models make of one motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lfd.models.dmp import DMP
from lfd.motion.demonstration import Demonstration, Situation
from lfd.motion.trajectory import Trajectory
from services.offline.demonstrations import demonstrate
from services.offline.rollout import rollout
from services.offline.steering import DURATION_S
from services.reproduction.analysis import Analysis, Claim, Context, Figure, Finding, Relation, Row, Source
from services.reproduction.functions import rms
from services.reproduction.models import CONTENDERS, DEFAULT, PRIMITIVE, Contender
from services.reproduction.scripted import object_grid, steady_motions
from services.reproduction.style import DEMONSTRATION_LINE, TRUE_LINE, Line, drawn, panels
from services.robot.arm import Arm
from services.robot.assembly import simulated_arm
from sim.robots.description import prepare
from sim.tasks import TABLE

Array = NDArray[np.float64]

_GRID = 3


@dataclass(frozen=True, eq=False)
class Shown:
    """What a model makes of one demonstration.

    Attributes:
        predictions: for each place of the object.
        reached: places at which the prediction succeeds when it is executed.
        error: root mean square distance to what a steady hand would do [m].
    """

    predictions: tuple[Trajectory, ...]
    reached: int
    error: float


def reproduced(primitive: DMP, motion: Demonstration, goal: Trajectory) -> Trajectory:
    """The primitive from a motion's own start to the last pose of another trajectory."""
    start, n = motion.trajectory, motion.trajectory.n_points
    return primitive.reproduce(
        (start.positions[0], start.orientations[0]), (goal.positions[-1], goal.orientations[-1]), DURATION_S, n
    )


def _dmp(context: Context) -> Finding:
    arm = simulated_arm(TABLE, TABLE.variants[0], prepare())
    taught = demonstrate(arm, TABLE, TABLE.training_positions[0], context.rng())
    motions = steady_motions(TABLE, object_grid(TABLE, _GRID))
    start = taught.situation
    asked = [Situation.reaching(m.origin, start.start_position, start.start_orientation) for m in motions]
    shown = {kind: _shown(kind, taught, asked, motions, arm) for kind in context.track(CONTENDERS)}
    primitive = DMP.fit(taught.trajectory)
    hardcoded = [reproduced(primitive, m, taught.trajectory) for m in motions]
    missed = _successes(hardcoded, motions, arm)
    total = len(motions)
    return Finding(
        _claims({kind: one.reached for kind, one in shown.items()}, total),
        (
            Row(
                "objects reached after one demonstration",
                {kind.name: one.reached for kind, one in shown.items()},
                thesis="“enough”",
                total=total,
                headline=True,
            ),
            Row(
                "objects reached with the goal hard-coded",
                {PRIMITIVE.name: missed},
                thesis="“will fail”",
                total=total,
            ),
            Row("RMSE of the path", {kind.name: 1e3 * one.error for kind, one in shown.items()}, "mm", headline=True),
        ),
        context.drawn(lambda: (_figure(taught, motions, {PRIMITIVE: shown[PRIMITIVE], DEFAULT: shown[DEFAULT]}),)),
        (
            f"Every model knows one motion over the table; objects stand at {_GRID} times {_GRID} places, and each"
            " prediction is executed in the simulator. The DMP's goal is the end of its motion, moved with the object."
            " The measure of the path is what a person with a steady hand would do.",
        ),
    )


def _claims(reached: Mapping[Contender, int], total: int) -> tuple[Claim, ...]:
    quantity = "objects reached"
    return (
        Claim(
            Source.THESIS,
            "For a DMP that is told where the object is one demonstration is enough.",
            quantity,
            reached[PRIMITIVE],
            Relation.AT_LEAST,
            total,
        ),
        Claim(
            Source.RETOUCH,
            "The default model makes as much of one demonstration as a DMP.",
            quantity,
            reached[DEFAULT],
            Relation.AT_LEAST,
            reached[PRIMITIVE],
            against=PRIMITIVE.label,
        ),
    )


def _shown(
    kind: Contender, taught: Demonstration, asked: Sequence[Situation], motions: Sequence[Demonstration], arm: Arm
) -> Shown:
    model, n = kind.fit([taught]), motions[0].trajectory.n_points
    predictions = tuple(replace(model.predict(one, n).trajectory, duration=DURATION_S) for one in asked)
    return Shown(predictions, _successes(predictions, motions, arm), _path_error(predictions, motions))


def _successes(trajectories: Sequence[Trajectory], motions: Sequence[Demonstration], arm: Arm) -> int:
    pairs = zip(trajectories, motions, strict=True)
    return sum(rollout(arm, t, m.origin, to_collision=True).verdict.success for t, m in pairs)


def _path_error(trajectories: Sequence[Trajectory], motions: Sequence[Demonstration]) -> float:
    """Root mean square distance to the motions [m]."""
    off = np.array([t.positions - m.trajectory.positions for t, m in zip(trajectories, motions, strict=True)])
    return rms(np.linalg.norm(off, axis=2))


def _figure(taught: Demonstration, motions: Sequence[Demonstration], shown: Mapping[Contender, Shown]) -> Figure:
    canvas, panes = panels([kind.label for kind in shown], height=3.1)
    for axes, (kind, one) in zip(panes, shown.items(), strict=True):
        demonstrated = taught.trajectory.positions
        axes.plot(demonstrated[:, 1], demonstrated[:, 0], **DEMONSTRATION_LINE("the one demonstration"))
        for prediction, motion in zip(one.predictions, motions, strict=True):
            p, real = prediction.positions, motion.trajectory.positions
            axes.plot(p[:, 1], p[:, 0], **Line(kind.line.color, 1.4)(kind.label))
            axes.plot(real[:, 1], real[:, 0], **TRUE_LINE("a steady hand"))
            axes.plot(motion.origin[1], motion.origin[0], "s", color="#3c6e57", ms=4, label="object")
        axes.set(xlabel="y [m]", aspect="equal")
    panes[0].set_ylabel("x [m]")
    return drawn(canvas, "predictions", "What is predicted from one demonstration, from above (Fig. B.22).")


DYNAMIC_MOVEMENT_PRIMITIVES = Analysis(
    name="dmp",
    reference="Fig. B.22",
    about="What does a dynamic movement primitive predict?",
    claim="One demonstration is enough, and the motion is guaranteed to converge to the goal. The goal is hardcoded;"
    " it can be extracted by an object detection module, but this always requires the object to be completely known,"
    " and DMP will fail otherwise.",
    run=_dmp,
    seconds=35.0,
)
