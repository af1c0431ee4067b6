"""How many people adapt a skill that fails, by one update, for each method of teaching and each device.

A hundred sessions each, of people who are simulated: they see late and misjudge depth, no two of their motions are the
same, and they act through the devices themselves: a key is down or up, a stick has a dead zone and a curve, a cap goes
a little astray, a wheel has notches, a stylus has a mass. Robot, master, model and station are the real ones, on a
clock that runs as fast as it can. The dishwasher's basket has been pulled out since its skill was taught; the object
stands at another place for each person. A session counts where the robot alone succeeds after one update; whose hand
missed may try again, three times in all.

People 0 to 19 are there to choose by; what a choice comes to is read from 100 to 199, the default.
"""

import argparse
import json
import os
import sys
from itertools import product
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.progress import Progress

from services.offline.first_demonstrations import first_demonstrations
from services.offline.people.session import TRIES, Session, all_taught
from services.offline.people.ways import Device, Teaching
from services.offline.proportion import Proportion
from services.offline.result import Arrangement
from sim.tasks import DISHWASHER

GOAL = 0.95
FIRST = 100
"""Seed of the first person who is reported."""


def sessions(teaching, device, seeds, demonstrations):
    """One session for each person, the object where it falls."""
    for seed in seeds:
        place = DISHWASHER.region.sample(np.random.default_rng((seed, 5)))
        arrangement = Arrangement.of(DISHWASHER.variants[-1], tuple(place.tolist()), has_object=True)
        yield Session(DISHWASHER.name, demonstrations, arrangement, teaching, device, seed)


def row(teaching, device, results):
    """What came of one method and device."""
    adapted = Proportion(sum(one.adapted for one in results), len(results))
    learnt = [one for one in results if one.learnt]
    return {
        "method": teaching.value,
        "device": device.value,
        "people": len(results),
        "adapted": adapted.successes,
        "interval": adapted.interval,
        "learnt": len(learnt),
        "at_first_try": sum(one.tries == 1 for one in learnt),
        "median_seconds": float(np.median([one.seconds for one in learnt])) if learnt else None,
        "goal": GOAL,
        "met": adapted.successes >= GOAL * adapted.trials,
        "failures": [one.why for one in results if not one.adapted],
    }


def told(one):
    """A row for people."""
    low, high = (round(100 * bound) for bound in one["interval"])
    took = "" if one["median_seconds"] is None else f", median {one['median_seconds']:.0f} s"
    verdict = f"goal {GOAL:.0%}: {'met' if one['met'] else 'MISSED'}"
    name = f"{one['method']} by {one['device']}"
    counted = f"{one['adapted']:4d} of {one['people']} ({low} to {high} %)"
    return f"{name:<28} {counted}, {one['at_first_try']} at the first try{took}   {verdict}"


def main():
    parser = argparse.ArgumentParser(
        prog="deploy/bench teaching", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--people", type=int, default=100, metavar="N", help="for each (default: 100)")
    parser.add_argument("--first", type=int, default=FIRST, metavar="SEED", help=f"of them (default: {FIRST})")
    parser.add_argument("--method", choices=[one.value for one in Teaching], help="only this one (default: all)")
    parser.add_argument("--device", choices=[one.value for one in Device], help="only this one (default: all)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, metavar="N", help="processes")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures as JSON")
    arguments = parser.parse_args()
    methods = [one for one in Teaching if arguments.method in (None, one.value)]
    devices = [one for one in Device if arguments.device in (None, one.value)]
    print(
        f"bench: {arguments.people} people by {len(methods)} methods and {len(devices)} devices, up to {TRIES} tries"
        " each; about fifteen seconds of a core for each session",
        file=sys.stderr,
    )
    demonstrations = tuple(first_demonstrations(DISHWASHER))
    seeds = range(arguments.first, arguments.first + arguments.people)
    rows = []
    for method, device in product(methods, devices):
        with Progress(console=Console(stderr=True), transient=True) as progress:
            task = progress.add_task(f"{method.value} by {device.value}", total=1.0)
            results = all_taught(
                list(sessions(method, device, seeds, demonstrations)),
                arguments.jobs,
                lambda share, progress=progress, task=task: progress.update(task, completed=share),
            )
        rows.append(row(method, device, results))
        print(told(rows[-1]), flush=True)
        if arguments.json is not None:
            arguments.json.write_text(json.dumps(rows, indent=2) + "\n")


if __name__ == "__main__":
    main()
