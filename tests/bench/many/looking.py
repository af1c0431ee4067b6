"""Whether a robot's control notices fifty observers: intervals with and without them, in turns."""

import contextlib
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

from tests.bench.many.fleet import late_share, regularity
from tests.bench.support.results import Result

OBSERVERS = 50
PERIOD_GOAL_MS = 1.0
"""The 99th percentile of the control period grows by no more: a tenth of the period."""

LATE_GOAL = 0.5
"""More late ticks [% of all]."""

SETTLE_S = 1.0


@contextlib.contextmanager
def observers(endpoint, robot):
    """The observers' process; how to tell it something."""
    program = [sys.executable, "-I", Path(__file__).with_name("observers.py"), endpoint, robot, str(OBSERVERS)]
    process = subprocess.Popen(program, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def tell(line):
        process.stdin.write(f"{line}\n")
        process.stdin.flush()
        return int(process.stdout.readline())

    try:
        if process.stdout.readline() != "ready\n":
            raise SystemExit("bench: the observers do not reach the router")
        yield tell
    finally:
        process.kill()
        process.wait()
        process.stdin.close()
        process.stdout.close()


def watched(fleet, turns, seconds):
    """The figures of a fleet's first robot, which is operated."""
    robot = fleet.names[0]
    alone, looked_at, heard = [], [], []
    with observers(fleet.endpoints[0], robot) as tell:
        for turn in range(turns):
            print(f"bench: {OBSERVERS} observers, turn {turn + 1} of {turns}", file=sys.stderr)
            alone.append(_interval(fleet, robot, seconds))
            tell("on")
            looked_at.append(_interval(fleet, robot, seconds))
            heard.append(tell("off"))
    figures = [regularity(beats) | {"late": 100.0 * late_share([beats])} for beats in (*alone, *looked_at)]
    names = (
        ("period_p99_ms", "control period p99", "ms", PERIOD_GOAL_MS),
        ("late", "late control ticks", "%", LATE_GOAL),
        ("latency_p99_ms", "sample to command p99", "ms", None),
    )
    yield Result(f"observers that hear the robot, of {OBSERVERS}", float(min(heard)), "")
    for key, about, unit, goal in names:
        values = np.array([each[key] for each in figures]).reshape(2, turns)
        yield Result(f"{about}, nobody looks", float(np.median(values[0])), unit)
        yield Result(f"{about}, {OBSERVERS} observers", float(np.median(values[1])), unit)
        yield Result(f"{about}, more with them, median of turns", float(np.median(values[1] - values[0])), unit, goal)


def _interval(fleet, robot, seconds):
    time.sleep(SETTLE_S)
    fleet.beats.take()
    time.sleep(seconds)
    return fleet.beats.take()[robot]
