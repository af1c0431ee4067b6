"""How well models predict recorded motions before they are corrected, and after: the default beside every baseline.

Leave one condition out: each condition of a set is predicted by a model of the others; time error is the root mean
square distance at equal times, path error that to the nearest point of the other path, both ways, end error that of the
last points. Coverage is the share of left-out coordinates inside the model's own 90 % intervals.

Refinements: each sequence is replayed from the initial model, in order. What counts is the share of the gap between
prediction and refinement (root mean square over the samples) that is left after the update, the gap before each later
refinement of the sequence, and the share of a gap that somebody else's correction at the same condition leaves.

The first leaves little choice in the other two. A model that leaves nothing of a correction predicts it to whoever asks
next in that situation, so what is then missed is how far people differ, from each other or from their own last motion:
"nearest + anchor" shows it. The gap before a person's correction is that of the initial model, which knows neither.

Options may be chosen on --part tune alone, and what a choice reaches is read from --part report;
tests/bench/evaluation/parts.py says which recordings are which. The baselines' options (tests/bench/baselines) were
chosen on the sets of the former.
"""

import argparse
import json
import sys
from dataclasses import asdict
from pathlib import Path

from rich.console import Console
from rich.progress import track
from threadpoolctl import threadpool_limits

from tests import recordings
from tests.bench.baselines.models import MODELS
from tests.bench.evaluation.left_out import leave_out
from tests.bench.evaluation.parts import Part, Recordings
from tests.bench.evaluation.refinements import adapt, transfer
from tests.bench.evaluation.report import Measured, show
from tests.bench.evaluation.summary import bests, figures, means
from tests.recordings import UnusableRecording

INITIAL = ("dishwasher_experiment/01.csv", "dishwasher_experiment/02.csv")
WIDTH = 150  # of the tables, also where nobody looks on


def measure(folder, initial, part):
    """Every model on the recordings of a part."""
    every = Recordings(recordings.sets(folder), recordings.sequences(folder))
    if not every.sets and not every.sequences:
        raise UnusableRecording(folder, "holds neither demonstrations nor refinements")
    chosen = every.part(part)
    adaptations, transfers, left_out = [], [], []
    first = _initial(folder, initial) if chosen.sequences else []
    console = Console(stderr=True)
    for model in track(list(MODELS) if first else [], "adapting", console=console, disable=not first):
        adaptations += [adapt(model, first, s) for s in chosen.sequences]
        transfers += transfer(model, first, chosen.sequences)
    work = [(name, model) for name in chosen.sets for model in MODELS]
    for name, model in track(work, "leaving out", console=console, disable=not work):
        left_out.append(leave_out(model, name, chosen.sets[name]))
    left_out = [row for row in left_out if row is not None]
    return Measured(part, chosen, every.part(Part.TUNE), adaptations, transfers, left_out)


def _initial(folder, paths):
    paths = paths or [folder / "demonstrations" / name for name in INITIAL]
    if not all(path.is_file() for path in paths):
        raise UnusableRecording(folder, f"has no demonstrations/{INITIAL[0]}: name the first two by --initial")
    return [recordings.demonstration(path) for path in paths]


def main():
    parser = argparse.ArgumentParser(
        prog="deploy/bench learning", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, required=True, metavar="FOLDER", help="see tests/recordings.py")
    parser.add_argument("--initial", type=Path, nargs=2, metavar="FILE", help="demonstrations of the initial model")
    parser.add_argument(
        "--part", type=Part, choices=list(Part), default=Part.ALL, help="of the recordings (%(default)s)"
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="write every sequence and set as JSON")
    arguments = parser.parse_args()
    try:
        if not (arguments.data / "demonstrations").is_dir():
            raise UnusableRecording(arguments.data, "has no folder demonstrations/")
        with threadpool_limits(1):  # as the processes of retouch have it; the matrices are small
            measured = measure(arguments.data, arguments.initial, arguments.part)
    except UnusableRecording as error:
        sys.exit(f"bench: {error}")
    results = figures(measured.adaptations, measured.transfers, measured.left_out)
    show(Console(width=WIDTH, markup=False, highlight=False), measured, results)
    if arguments.json is not None:
        content = {
            "part": measured.part,
            "operators": measured.chosen.operators,
            "tuned_on": {"sets": list(measured.tuned_on.sets), "operators": measured.tuned_on.operators},
            "figures": [asdict(f) for f in results],
            "sequences": [{**asdict(a), "left": a.left} for a in measured.adaptations],
            "sets": [asdict(r) for r in measured.left_out],
            "transfers": [asdict(t) for t in measured.transfers],
            "best": [{**asdict(b), "ratio": b.ratio} for e in ("time", "path") for b in bests(measured.left_out, e)],
            "means": [asdict(m) for m in means(measured.left_out)],
        }
        arguments.json.write_text(json.dumps(content, indent=2, default=float) + "\n")


if __name__ == "__main__":
    main()
