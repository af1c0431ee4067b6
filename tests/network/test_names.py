"""After a cut the transport has delivered messages under another robot's key: none of them counts."""

import json
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from services.bus.zenoh import connect
from services.process.clock import SystemClock
from tests.network.naming import TOPICS, named
from tests.system.harness import START_S, eventually

pytestmark = [pytest.mark.system, pytest.mark.zenoh]

ROBOTS = ("r0", "r1", "r2", "r3")
CUTS = 20
BETWEEN_S = 1.5
PERIOD_S = 0.02
ROLES = {"safety/state": "robot", "safety/emergency_stop": "master", "cmd/operator_input": "station"}


class Listener:
    """The far process; a context manager."""

    def __init__(self, link, router):
        program = Path(__file__).with_name("far_listener.py")
        self._process = subprocess.Popen(
            [*link.there, sys.executable, program, router, *ROBOTS],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        assert self._process.stdout.readline() == "listening\n"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.kill()
        self._process.communicate()

    def look(self):
        """Let it look at what has come."""
        self._say("look")

    def told(self):
        """What became of everything so far, robot by robot."""
        self._say("tell")
        return json.loads(self._process.stdout.readline())

    def _say(self, word):
        self._process.stdin.write(f"{word}\n")
        self._process.stdin.flush()


@pytest.fixture
def talking(router):
    """Four robots' processes that publish all the time."""
    end = threading.Event()
    buses = {
        (robot, topic): connect(router, robot, ROLES[topic.name], SystemClock()) for robot in ROBOTS for topic in TOPICS
    }

    def talk():
        while not end.wait(PERIOD_S):
            for (robot, topic), bus in buses.items():
                bus.publish(topic, named(robot, topic))

    talker = threading.Thread(target=talk)
    talker.start()
    yield
    end.set()
    talker.join()
    for bus in buses.values():
        bus.close()


def test_nothing_counts_under_a_key_that_is_not_its_own(link, router, talking):
    rng = np.random.default_rng(7)
    with Listener(link, router) as listener:

        def everything_comes(before):
            def more():
                listener.look()
                now = listener.told()
                return all(
                    now[robot]["counted"][topic.name] > before[robot]["counted"][topic.name]
                    for robot in ROBOTS
                    for topic in TOPICS
                )

            return more

        eventually(everything_comes(listener.told()), START_S, "everything is heard")
        for length in rng.uniform(1.5, 2.5, CUTS):
            link.cut()
            time.sleep(length)
            link.restore()
            before = listener.told()
            eventually(everything_comes(before), START_S, "everything is heard again")
            deadline = time.monotonic() + BETWEEN_S
            while time.monotonic() < deadline:
                listener.look()
                time.sleep(PERIOD_S)
        told = listener.told()
    assert {robot: told[robot]["wrong"] for robot in ROBOTS} == {robot: [] for robot in ROBOTS}
