"""Dynamic time warping: the thesis' worked example, and what it does to demonstrations and refinements."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lfd.motion.alignment import align, warp
from lfd.motion.demonstration import Demonstration
from lfd.motion.dtw import dtw
from lfd.motion.resampling import at_phases, resample
from lfd.motion.trajectory import Trajectory
from services.offline.steering import DURATION_S
from services.reproduction.analysis import Analysis, Claim, Context, Figure, Finding, Relation, Row, Source, Value
from services.reproduction.functions import rms
from services.reproduction.models import THESIS
from services.reproduction.scripted import demonstrate
from services.reproduction.style import CONDITIONED, DEMONSTRATION, REFINEMENT, Line, drawn, panels
from sim.tasks import DISHWASHER, TABLE

Array = NDArray[np.float64]

EXAMPLE_X = np.array([1.0, 2.0, 4.0, 3.0])
EXAMPLE_Y = np.array([1.0, 1.0, 2.0, 4.0])
TABLE_D1 = np.array([[0, 1, 4, 6], [0, 1, 4, 6], [1, 0, 2, 3], [4, 2, 0, 1]], dtype=np.float64)
"""Table D.1: the accumulated distance, a row for each of `EXAMPLE_Y` from the bottom up, a column for each X."""

_POINTS = 780  # of Fig. D.4 to D.6
_SLOWER = 16.0  # [s] duration of the slower motion
_LATER = 1.7  # exponent of the phase by which the slower motion lags
_BULGE = 0.05  # [m] to either side of the straight way
_STOPS_AT = 0.93  # share of the prediction at which the refinement stops, so as not to kick the object over


def accumulated(x: Array, y: Array) -> Array:
    """The matrix of equation (D.1), shape (len(y), len(x)): each entry is the distance of two beginnings."""
    return np.array([[dtw(x[: i + 1, None], y[: j + 1, None]).distance for i in range(len(x))] for j in range(len(y))])


def _time_warping(context: Context) -> Finding:
    rng = context.rng()
    example = dtw(EXAMPLE_X[:, None], EXAMPLE_Y[:, None])
    agreeing = int(np.sum(accumulated(EXAMPLE_X, EXAMPLE_Y) == TABLE_D1))
    i, j = example.path.T
    quick, slow = _two_speeds(rng)
    resampled = resample(slow, _POINTS)
    warped = warp(resampled, onto=resample(quick, _POINTS))
    context.advance(0.4)
    around = _three_ways(rng)
    kept = align(around)
    before, after = _to_mean(around), _to_mean(kept)
    prediction, whole, refinement = _correction(rng)
    together = warp(refinement, onto=prediction)
    context.advance(0.8)
    again = demonstrate(TABLE, TABLE.training_positions[-1], rng).trajectory
    alike, correction = _apart(again, quick), _apart(whole, prediction)

    def row(quantity: str, value: Value, unit: str = "", thesis: Value | None = None, *, headline: bool = False) -> Row:
        return Row(quantity, {THESIS.name: value}, unit, thesis, headline=headline)

    return Finding(
        (
            Claim(
                Source.THESIS,
                "The accumulated distances of the worked example are those of Table D.1, its own distance 1.",
                "entries that agree",
                agreeing,
                Relation.AT_LEAST,
                TABLE_D1.size,
            ),
            Claim(
                Source.THESIS,
                "Resampled demonstrations of different speed are not well aligned: they are further apart than two of"
                " the same speed.",
                "RMS distance",
                1e3 * _apart(resampled, quick),
                Relation.ABOVE,
                1e3 * alike,
                against="same speed",
                unit="mm",
            ),
            Claim(
                Source.THESIS,
                "When DTW is used they are aligned: no further apart than two of the same speed.",
                "RMS distance",
                1e3 * _apart(warped, quick),
                Relation.AT_MOST,
                1e3 * alike,
                against="same speed",
                unit="mm",
            ),
            Claim(
                Source.THESIS,
                "Prediction and refinement have successfully been aligned: they are no further apart than by the"
                " correction itself.",
                "RMS distance",
                1e3 * _apart(together, prediction),
                Relation.AT_MOST,
                1e3 * correction,
                against="the correction",
                unit="mm",
            ),
        ),
        (
            row("entries of Table D.1 that agree, of 16", agreeing, thesis=16, headline=True),
            row("distance of the example", example.distance, thesis=1),
            row("length of its warping path", len(example.path), thesis=5),
            row("X as it is warped", _listed(EXAMPLE_X[i]), thesis="1 1 2 4 4"),
            row("Y as it is warped", _listed(EXAMPLE_Y[j]), thesis="1 1 2 4 3"),
            row("one speed: RMS distance of two motions", 1e3 * alike, "mm"),
            row(
                "two speeds, resampled: RMS distance",
                1e3 * _apart(resampled, quick),
                "mm",
                "“not well aligned”",
                headline=True,
            ),
            row(
                "two speeds, warped: RMS distance", 1e3 * _apart(warped, quick), "mm", "“better aligned”", headline=True
            ),
            row("three ways, resampled: RMS distance from their mean", 1e3 * before, "mm"),
            row("three ways, aligned: RMS distance from their mean", 1e3 * after, "mm", "“aligned”"),
            row("refinement and prediction, in one tempo: RMS distance", 1e3 * correction, "mm"),
            row("refinement and prediction, by number: RMS distance", 1e3 * _apart(refinement, prediction), "mm"),
            row(
                "refinement and prediction, warped",
                1e3 * _apart(together, prediction),
                "mm",
                "“successfully aligned”",
            ),
        ),
        context.drawn(
            lambda: (
                _speeds_figure(quick, resampled, warped),
                _refinement_figure(prediction, refinement, together),
                _ways_figure(around, kept),
            )
        ),
        (
            "The arrays that the text prints below Table D.1 are exchanged: X has to be the one that ends in 3. The"
            " thesis uses FastDTW, an"
            " approximation; here the warping is exact. It keeps two demonstrations of each condition, the reference"
            " and the one most similar to it; here all are matched to the reference and kept.",
            f"Two speeds: one way over the table in {DURATION_S:g} s and, hesitating at first, in {_SLOWER:g} s; both"
            f" with {_POINTS} points. Three ways: to one object straight, and passing {1e2 * _BULGE:g} cm to either"
            " side, at three paces; that they pass on three ways is what is left. Refinement: the motion round the"
            " basket that was pulled out, stopping short of the prediction's end; what is left is the correction.",
        ),
    )


def _listed(values: Array) -> str:
    return " ".join(f"{value:g}" for value in values)


def _hesitating(trajectory: Trajectory, exponent: float, duration: float) -> Trajectory:
    return replace(at_phases(trajectory, trajectory.phases**exponent), duration=duration)


def _two_speeds(rng: np.random.Generator) -> tuple[Trajectory, Trajectory]:
    quick, slow = (demonstrate(TABLE, TABLE.training_positions[-1], rng).trajectory for _ in range(2))
    return quick, _hesitating(slow, _LATER, _SLOWER)


def _three_ways(rng: np.random.Generator) -> list[Demonstration]:
    ways = []
    for side, exponent in ((-1.0, 1.3), (1.0, 0.8), (0.0, 1.0)):
        motion = demonstrate(DISHWASHER, DISHWASHER.training_positions[0], rng)
        t = motion.trajectory
        bulged = t.positions + np.outer(np.sin(np.pi * t.phases) ** 2, [0.0, side * _BULGE, 0.0])
        way = _hesitating(replace(t, positions=bulged), exponent, DURATION_S)
        ways.append(replace(motion, trajectory=way))
    return ways


def _correction(rng: np.random.Generator) -> tuple[Trajectory, Trajectory, Trajectory]:
    """A prediction, the corrected motion in its tempo, and the refinement, which stops earlier."""
    place, (old, new) = DISHWASHER.training_positions[0], DISHWASHER.variants
    prediction = demonstrate(DISHWASHER, place, rng, variant=old).trajectory
    corrected = demonstrate(DISHWASHER, place, rng, variant=new).trajectory
    return prediction, corrected, at_phases(corrected, _STOPS_AT * prediction.phases)


def _apart(a: Trajectory, b: Trajectory) -> float:
    """Root mean square distance of two trajectories, point by point [m]."""
    n = max(a.n_points, b.n_points)
    return rms(np.linalg.norm(resample(a, n).positions - resample(b, n).positions, axis=1))


def _to_mean(motions: list[Demonstration]) -> float:
    """Root mean square distance of motions from their mean, point by point [m]."""
    positions = np.array([m.trajectory.positions for m in motions])
    return rms(np.linalg.norm(positions - positions.mean(axis=0), axis=2))


def _speeds_figure(quick: Trajectory, resampled: Trajectory, warped: Trajectory) -> Figure:
    canvas, panes = panels(["resampled", "warped"], height=2.6)
    for axes, other in zip(panes, (resampled, warped), strict=True):
        for axis, style in ((1, "-"), (2, "--")):
            name = "xyz"[axis]
            axes.plot(
                quick.phases * _POINTS, quick.positions[:, axis], **Line(DEMONSTRATION, 2.4, style)(f"quick, {name}")
            )
            axes.plot(
                other.phases * _POINTS, other.positions[:, axis], **Line(CONDITIONED, 1.4, style)(f"slow, {name}")
            )
        axes.set_xlabel("point")
    panes[0].set_ylabel("position [m]")
    return drawn(canvas, "speeds", "Two demonstrations of one condition at different speeds (Fig. D.4 to D.6).")


def _refinement_figure(prediction: Trajectory, refinement: Trajectory, together: Trajectory) -> Figure:
    canvas, panes = panels(["by number", "warped"], height=2.6)
    for axes, other in zip(panes, (refinement, together), strict=True):
        for axis, style in ((0, "-"), (1, "--"), (2, ":")):
            name = "xyz"[axis]
            points = np.arange(1, prediction.n_points + 1)
            axes.plot(points, prediction.positions[:, axis], **Line(CONDITIONED, 1.6, style)(f"prediction, {name}"))
            axes.plot(points, other.positions[:, axis], **Line(REFINEMENT, 1.6, style)(f"refinement, {name}"))
        axes.set_xlabel("point")
    panes[0].set_ylabel("position [m]")
    return drawn(canvas, "refinement", "A prediction and its refinement, which stops earlier (Fig. B.8).")


def _ways_figure(around: list[Demonstration], kept: list[Demonstration]) -> Figure:
    canvas, panes = panels(["as demonstrated", "aligned"], height=2.4)
    styles = (Line("#0072b2", 1.5), Line("#d55e00", 1.5), Line("#009e73", 1.5))
    for axes, motions in zip(panes, (around, kept), strict=True):
        for motion, line, name in zip(motions, styles, ("one side", "other side", "straight"), strict=True):
            axes.plot(motion.trajectory.phases * 100.0, motion.trajectory.positions[:, 0], **line(name))
        axes.set_xlabel("share of the points [%]")
    panes[0].set_ylabel("x [m]")
    return drawn(canvas, "ways", "Three demonstrations of one condition, which pass on three ways (Fig. D.1 and D.3).")


TIME_WARPING = Analysis(
    name="time-warping",
    reference="Table D.1, Fig. B.8, D.3-D.6",
    about="Does dynamic time warping align motions of different speed?",
    claim="The distance of the worked example is 1 and its optimal warping path has a length of 5. Resampled"
    " demonstrations are not well aligned; when instead DTW is used they are better aligned. Prediction and refinement"
    " have successfully been aligned.",
    run=_time_warping,
    seconds=3.5,
)
