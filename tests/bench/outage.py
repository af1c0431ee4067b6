"""How soon a stop that was pressed in an outage of the network is latched once the link is back.

A far operator on a link that is really cut, the robot and its router here; needs root and `ip`. Part of the outages
have busy loops beside them.
"""

import argparse
import contextlib
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from protocol import queries
from services.bus.identity import new_number
from tests.bench.support.results import Result, write_json
from tests.network.link import Impossible, Link
from tests.network.operator import Operator
from tests.system.harness import START_S, Command, Witness, eventually, free_port, reachable
from tests.system.onlooker import Onlooker

GOAL_S = 0.3
CUT_S = 5.0
SETTLE_S = 1.0
"""Between two outages; a press on its way has come by then."""

PHASE_S = 1.0
"""An outage is longer by up to so much, so that the link comes back at any moment between two attempts to dial."""

LOOPS = 2


@contextlib.contextmanager
def busy(loops):
    """So many processes that do nothing, as fast as they can."""
    running = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(loops)]
    try:
        yield
    finally:
        for process in running:
            process.kill()
            process.wait()


def latched_after(link, onlooker, operator, longer):
    """Cut the link, let the operator press, and mend it: how soon then the robot said that it has latched [s]."""
    cut = link.cut()
    time.sleep(CUT_S / 2)
    operator.press()
    time.sleep(max(0.0, cut + CUT_S + longer - time.monotonic()))
    if onlooker.safety["emergency_stop"]:
        raise SystemExit("bench: the stop passed a link that is cut")
    back = link.restore()
    eventually(lambda: onlooker.safety["emergency_stop"], START_S, "the stop is latched")
    seconds = time.monotonic() - back
    operator.says("confirmed")
    return seconds


def measure(link, folder, outages, loops):
    """The times [s]."""
    router = f"tcp/{link.near}:{free_port()}"
    with contextlib.ExitStack() as running:
        command = running.enter_context(Command("router", "--insecure", "--listen", router, folder=folder))
        command.until(lambda: reachable(router), START_S, "the router listens")
        running.enter_context(busy(loops))
        running.enter_context(Command("robot", "--scene", "particle", "--insecure", "--connect", router, folder=folder))
        onlooker = running.enter_context(Onlooker(router))
        witness = running.enter_context(Witness(router))
        operator = running.enter_context(Operator(link, router))
        operator.says("executing")
        for longer in np.random.default_rng(5).uniform(0.0, PHASE_S, outages):
            time.sleep(SETTLE_S)
            seconds = latched_after(link, onlooker, operator, longer)
            print(f"bench: {seconds:.3f} s", file=sys.stderr)
            yield seconds
            time.sleep(SETTLE_S)
            witness.asked(queries.RELEASE_STOP, queries.ReleaseStop("bench", request=new_number()))


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="deploy/bench outage", description=__doc__)
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures as JSON")
    parser.add_argument("--outages", type=int, default=10, metavar="N", help="quiet ones, and as many busy ones")
    options = parser.parse_args(arguments)
    if options.json is not None and not options.json.parent.is_dir():
        parser.error(f"--json: the folder {options.json.parent} does not exist")
    results = []
    try:
        for name, loops in (("quiet", 0), ("busy", LOOPS)):
            with Link() as link, tempfile.TemporaryDirectory() as folder:
                times = list(measure(link, Path(folder), options.outages, loops))
            results.append(Result(f"latched, {name}, median", float(np.median(times)), "s", GOAL_S))
            results.append(Result(f"latched, {name}, worst", max(times), "s", GOAL_S))
    except Impossible as reason:
        raise SystemExit(f"bench: {reason}") from None
    for result in results:
        print(f"{result.name:<24} {result.value:8.3f} {result.unit}   {result.verdict}")
    if options.json is not None:
        write_json(options.json, results)


if __name__ == "__main__":
    main()
