"""The loop over bad networks: whether it closes, how late commands come, how long the robot holds, how it goes.

Robot and desk are real processes on two machines as far as their network, clock and memory go, joined by a link that
delays, loses, queues and is cut; needs root, /dev/net/tun, `ip` and `unshare`. A run of a minute a case.
"""

import argparse
import sys
from pathlib import Path

from tests.bench.support.results import Result, write_json
from tests.network.cases import CASES, run
from tests.network.link import Impossible

HEAD = (
    f"{'case':<32}{'closed':>7}{'up p50/p99':>14}{'down p50/p99':>14}{'held':>7}{'hold after':>11}{'oldest':>8}"
    f"{'jerk':>7}{'unasked':>9}{'pictures':>10}{'age p50/p99':>14}"
)
UNITS = (
    f"{'':<32}{'':>7}{'[ms]':>14}{'[ms]':>14}{'[%]':>7}{'[ms]':>11}{'[ms]':>8}{'[m/s3]':>7}{'[mm]':>9}{'[1/s]':>10}"
    f"{'[ms]':>14}"
)


def row(case, outcome):
    """One line of the table."""
    f = outcome.figures
    return (
        f"{case.name:<32}{'yes' if outcome.closed else 'NO':>7}{_pair(f.up_ms):>14}{_pair(f.down_ms):>14}"
        f"{100 * f.held:>7.1f}{f.hold_after_ms:>11.0f}{f.oldest_ms:>8.0f}{f.jerk:>7.2f}"
        f"{max(f.unasked_mm, outcome.gone_mm):>9.2f}{f.pictures_hz:>10.1f}{_pair(f.pictures_ms):>14}"
    )


def _pair(quantiles):
    return "/".join(f"{value:.0f}" for value in quantiles)


def results(case, outcome):
    """The figures, each beside its goal."""
    f = outcome.figures
    yield Result(f"{case.name}: not closed", float(not outcome.closed), "", 0.0)
    yield Result(f"{case.name}: hold after the last sample", f.hold_after_ms, "ms", 200.0)
    yield Result(f"{case.name}: oldest applied", f.oldest_ms, "ms", 250.0)
    yield Result(f"{case.name}: moved unasked", max(f.unasked_mm, outcome.gone_mm), "mm", 0.1)
    late = case.path_ms + 100.0 if case.shape.get("rate") else None
    yield Result(f"{case.name}: up p99", f.up_ms[1], "ms", late)
    yield Result(f"{case.name}: up p50, less what the robot tells", f.up_ms[0] - f.told_ms[0], "ms")
    yield Result(f"{case.name}: down p99", f.down_ms[1], "ms", late)
    yield Result(f"{case.name}: jerk", f.jerk, "m/s3")
    yield Result(f"{case.name}: held", 100.0 * f.held, "%")


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="deploy/bench network", description=__doc__)
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures as JSON")
    parser.add_argument("--only", metavar="TEXT", default="", help="the cases in whose names the text stands")
    options = parser.parse_args(arguments)
    if options.json is not None and not options.json.parent.is_dir():
        parser.error(f"--json: the folder {options.json.parent} does not exist")
    chosen = [case for case in CASES if options.only in case.name]
    if not chosen:
        parser.error(f"--only: no case of this name; there are {', '.join(case.name for case in CASES)}")
    print(f"{HEAD}\n{UNITS}", flush=True)
    figures = []
    try:
        for case in chosen:
            outcome = run(case)
            print(row(case, outcome), flush=True)
            if not outcome.closed:
                print(outcome.told, file=sys.stderr)
            figures.extend(results(case, outcome))
    except Impossible as reason:
        raise SystemExit(f"bench: {reason}") from None
    for missed in (result for result in figures if result.met is False):
        print(f"{missed.name}: {missed.value:.1f} {missed.unit}, {missed.verdict}")
    if options.json is not None:
        write_json(options.json, figures)


if __name__ == "__main__":
    main()
