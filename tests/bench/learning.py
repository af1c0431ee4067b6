"""How well both models adapt to recorded corrections and predict recorded motions that they have not seen.

Adaptation: each sequence of refinements is replayed from the initial model, in order; what counts is the share of the
gap between prediction and refinement (root mean square over the samples) that is left after the update. Leave one
condition out: each condition of a set is predicted by a model of the others; time error is the root mean square
distance at equal times, path error that to the nearest point of the other path, both ways. Coverage is the share of
left-out coordinates inside the model's own 90 % intervals.
"""

import argparse
import json
import sys
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.progress import track
from rich.table import Table
from scipy.spatial.distance import cdist

from lfd.models.adaptive.adaptation import AdaptiveProMP
from lfd.models.promp import ConditionedProMP
from lfd.motion.alignment import group_by_condition
from tests import recordings
from tests.recordings import UnusableRecording

MODELS = {"default": AdaptiveProMP, "thesis": ConditionedProMP}
INITIAL = ("dishwasher_experiment/01.csv", "dishwasher_experiment/02.csv")
SAME_CONDITION = 0.02  # [m] the marker's noise is a few millimetres, and people put an object back to within some more
WIDTH = 128  # of the tables, also where nobody looks on
NINETY_PER_CENT = 1.6448536  # of a Gaussian, in standard deviations


@dataclass(frozen=True)
class Adaptation:
    """One model on one sequence: the gap before and after each update [m]."""

    model: str
    sequence: str
    before: tuple[float, ...]
    after: tuple[float, ...]

    @property
    def left(self):
        return [after / before for before, after in zip(self.before, self.after, strict=True)]


@dataclass(frozen=True)
class LeftOut:
    """One model on one set, means over the demonstrations left out: errors [m] and coverage [-]."""

    model: str
    name: str
    conditions: int
    demonstrations: int
    time: float
    path: float
    end: float
    coverage: float


@dataclass(frozen=True)
class Figure:
    """What the default model reaches beside its goal and beside the thesis' model."""

    name: str
    default: float
    thesis: float
    unit: str
    goal: str
    met: bool


def gap(model, wanted):
    predicted = model.predict(wanted.situation, wanted.trajectory.n_points).trajectory.positions
    return float(np.sqrt(np.mean(np.sum((predicted - wanted.trajectory.positions) ** 2, axis=1))))


def adapt(name, initial, sequence):
    model = MODELS[name].fit(initial)
    before, after = [], []
    for refinement in sequence.refinements:
        before.append(gap(model, refinement))
        model = model.updated(refinement)
        after.append(gap(model, refinement))
    return Adaptation(name, sequence.name, tuple(before), tuple(after))


def leave_out(name, set_name, demonstrations):
    groups = group_by_condition(np.array([d.condition for d in demonstrations]), SAME_CONDITION)
    rows = []
    for group in groups:
        rest = [d for i, d in enumerate(demonstrations) if i not in group]
        if rest:
            model = MODELS[name].fit(rest)
            rows += [_errors(model, demonstrations[i]) for i in group]
    if not rows:
        return None
    return LeftOut(name, set_name, len(groups), len(demonstrations), *np.mean(rows, axis=0).tolist())


def _errors(model, wanted):
    truth = wanted.trajectory.positions
    prediction = model.predict(wanted.situation, len(truth))
    predicted = prediction.trajectory.positions
    error = truth - predicted
    distances = cdist(truth, predicted)
    nearest = np.concatenate([distances.min(axis=0), distances.min(axis=1)])
    deviations = np.sqrt(np.diagonal(prediction.position_covariances, axis1=1, axis2=2))
    # The first point is where the robot stands: nothing is predicted there.
    inside = np.abs(error[1:]) <= NINETY_PER_CENT * deviations[1:]
    return [
        np.sqrt(np.mean(np.sum(error**2, axis=1))),
        np.sqrt(np.mean(nearest**2)),
        np.linalg.norm(error[-1]),
        np.mean(inside),
    ]


def figures(adaptations, left_out):
    results = []
    if adaptations:
        first = {m: np.array([a.left[0] for a in adaptations if a.model == m]) for m in MODELS}
        later = {m: np.array([x for a in adaptations if a.model == m for x in a.left[1:]]) for m in MODELS}
        results.append(_at_most("gap left after one update, median", first, np.median, 0.04))
        results.append(_at_most("gap left after one update, nine in ten", first, lambda x: np.quantile(x, 0.9), 0.10))
        if len(later["default"]):
            results.append(_at_most("gap left after later updates, median", later, np.median, 0.07))
    if left_out:
        for key in ("time", "path"):
            means = {m: np.mean([getattr(r, key) for r in left_out if r.model == m]) for m in MODELS}
            gain = 1.0 - means["default"] / means["thesis"]
            results.append(
                Figure(
                    f"left-out {key} error, mean of the sets",
                    means["default"],
                    means["thesis"],
                    "m",
                    f"8 % under ({gain:.1%})",
                    gain >= 0.08,
                )
            )
            worst = max(a / b for a, b in _pairs(left_out, key))
            results.append(
                Figure(f"left-out {key} error, worst set", worst, 1.0, "of the thesis'", "at most 1", worst <= 1.0)
            )
        cover = {m: _weighted([r for r in left_out if r.model == m]) for m in MODELS}
        met = 0.80 <= cover["default"] <= 0.97
        results.append(
            Figure("90 % intervals cover", cover["default"], cover["thesis"], "of the points", "0.80 to 0.97", met)
        )
    return results


def _at_most(name, values, statistic, goal):
    default, thesis = (float(statistic(values[m])) for m in MODELS)
    return Figure(name, default, thesis, "of the gap", f"at most {goal:g}", default <= goal)


def _pairs(left_out, key):
    by_set = {(r.model, r.name): getattr(r, key) for r in left_out}
    return [(by_set["default", n], by_set["thesis", n]) for m, n in by_set if m == "default"]


def _weighted(rows):
    return float(np.average([r.coverage for r in rows], weights=[r.demonstrations for r in rows]))


def show(console, left_out, results):
    sets = Table("set", "conditions", "demonstrations", "time [m]", "path [m]", "end [m]", "coverage", title="Left out")
    for r in left_out:
        other = next((t for t in left_out if t.model == "thesis" and t.name == r.name), None)
        if r.model == "default" and other is not None:
            cells = [f"{getattr(r, k):.4f} / {getattr(other, k):.4f}" for k in ("time", "path", "end")]
            cells.append(f"{r.coverage:.2f} / {other.coverage:.2f}")
            sets.add_row(r.name, str(r.conditions), str(r.demonstrations), *cells)
    if left_out:
        console.print(sets, "each cell: default model / thesis' model")
    summary = Table("figure", "default", "thesis", "", "goal", "", title="Both models")
    for f in results:
        summary.add_row(f.name, f"{f.default:.4f}", f"{f.thesis:.4f}", f.unit, f.goal, "met" if f.met else "MISSED")
    console.print(summary)


def measure(folder, initial):
    sets = recordings.sets(folder)
    sequences = recordings.sequences(folder)
    if not sets and not sequences:
        raise UnusableRecording(folder, "holds neither demonstrations nor refinements")
    if sequences and initial is None:
        initial = [folder / "demonstrations" / name for name in INITIAL]
        if not all(path.is_file() for path in initial):
            raise UnusableRecording(folder, f"has no demonstrations/{INITIAL[0]}: name the first two by --initial")
    adaptations, left_out = [], []
    first = [recordings.demonstration(path) for path in initial] if sequences else []
    work = [(m, s) for s in sequences for m in MODELS]
    console = Console(stderr=True)
    for model, sequence in track(work, "adapting", console=console, disable=not work):
        adaptations.append(adapt(model, first, sequence))
    for name, demonstrations in track(sets.items(), "leaving out", total=len(sets), console=console):
        rows = [leave_out(model, name, demonstrations) for model in MODELS]
        left_out += [row for row in rows if row is not None]
    return adaptations, left_out


def main():
    parser = argparse.ArgumentParser(
        prog="deploy/bench learning", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, required=True, metavar="FOLDER", help="see tests/recordings.py")
    parser.add_argument("--initial", type=Path, nargs=2, metavar="FILE", help="demonstrations of the initial model")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write every sequence and set as JSON")
    arguments = parser.parse_args()
    try:
        if not (arguments.data / "demonstrations").is_dir():
            raise UnusableRecording(arguments.data, "has no folder demonstrations/")
        adaptations, left_out = measure(arguments.data, arguments.initial)
    except UnusableRecording as error:
        sys.exit(f"bench: {error}")
    results = figures(adaptations, left_out)
    show(Console(width=WIDTH), left_out, results)
    if arguments.json is not None:
        content = {
            "figures": [asdict(f) for f in results],
            "sequences": [{**asdict(a), "left": a.left} for a in adaptations],
            "sets": [asdict(r) for r in left_out],
        }
        arguments.json.write_text(json.dumps(content, indent=2, default=float) + "\n")


if __name__ == "__main__":
    main()
