"""How soon others see that a process is there, or has gone: its token on the network, seen across two routers."""

import contextlib
import os
import signal
import sys
import threading
import time

import numpy as np
import zenoh

from protocol.topic import VERSION
from services.bus.zenoh import connect, open_session
from services.process.clock import SystemClock
from tests.bench.support.results import Result
from tests.system.harness import START_S, eventually

BACK_GOAL_S, LOST_GOAL_S = 1.0, 1.5
WITHIN_S = 30.0


class Tokens:
    """Which processes of which robots are there, and since when they are or are not; a context manager.

    Args:
        endpoint: of the router that they are seen from.
    """

    def __init__(self, endpoint):
        self._session = open_session(endpoint, START_S)
        self._seen = {}
        self._exchange = threading.Lock()
        key = f"retouch/{VERSION}/*/alive/*"
        self._session.declare(lambda now: now.liveliness().declare_subscriber(key, self._hear, history=True))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._session.close()

    def _hear(self, sample):
        _, _, robot, _, process = str(sample.key_expr).split("/")
        with self._exchange:
            self._seen[robot, process] = (sample.kind == zenoh.SampleKind.PUT, time.monotonic())

    def since(self, robot, there, began, process="robot"):
        """Wait until a process was seen to come, or to go, after a moment; how long after [s]."""

        def seen():
            with self._exchange:
                is_there, at = self._seen.get((robot, process), (None, 0.0))
            return at if is_there is there and at >= began else None

        return eventually(seen, WITHIN_S, f"{robot} is seen to {'come' if there else 'go'}") - began


def measure(fleet, trials):
    """The figures: robots under the first router of a fleet, seen from the last one."""
    times = {"announced": [], "killed": [], "stopped": [], "back": []}
    with Tokens(fleet.endpoints[-1]) as tokens:
        for trial in range(trials):
            print(f"bench: presence, trial {trial + 1} of {trials}", file=sys.stderr)
            began, name = time.monotonic(), f"walker{trial}"
            times["announced"].append(_announced(fleet.endpoints[0], tokens, name))
            robot = fleet.start(name)
            tokens.since(name, True, began)
            fleet.beats.until([name])
            with _standing(robot.process.pid):
                times["stopped"].append(tokens.since(name, False, time.monotonic()))
            times["back"].append(tokens.since(name, True, time.monotonic()))
            killed = time.monotonic()
            robot.process.kill()
            times["killed"].append(tokens.since(name, False, killed))
            robot.stop()
    for name, about, goal in (
        ("announced", "a process dials its router, until it is seen", BACK_GOAL_S),
        ("back", "a process that stood goes on, until it is seen", BACK_GOAL_S),
        ("stopped", "a process stands still, until it is seen lost", LOST_GOAL_S),
        ("killed", "a process is killed, until it is seen lost", LOST_GOAL_S),
    ):
        yield Result(f"{about}, median", float(np.median(times[name])), "s", goal)
        yield Result(f"{about}, longest", max(times[name]), "s", goal)


def _announced(endpoint, tokens, robot):
    """How long after a process begins to dial its router it is seen [s]."""
    began = time.monotonic()
    bus = connect(endpoint, robot, "bench", SystemClock(), timeout_s=START_S)
    try:
        return tokens.since(robot, True, began, "bench")
    finally:
        bus.close()


@contextlib.contextmanager
def _standing(pid):
    """A process does nothing meanwhile, and its link says nothing."""
    os.kill(pid, signal.SIGSTOP)
    try:
        yield
    finally:
        os.kill(pid, signal.SIGCONT)
