"""After a cut the transport has delivered messages under another robot's key: none of them counts."""

import json
import subprocess
import sys
import threading
import time
from contextlib import ExitStack
from pathlib import Path

import numpy as np
import pytest

from services.bus.zenoh import connect
from services.process.clock import SystemClock
from tests.network.link import Impossible, Link
from tests.network.naming import TOPICS, named
from tests.ports import free_port
from tests.system.harness import START_S, Command, eventually, reachable

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.alone]

ROBOTS = ("r0", "r1", "r2", "r3")
LINKS = 4
CUTS = 5
"""Of each link."""

WATCHED_S = 1.5
"""After a cut: what had waited has come by then."""

PERIOD_S = 0.02
ROLES = {"safety/state": "robot", "safety/emergency_stop": "master", "cmd/operator_input": "station"}


class Listener:
    """The far process at the end of a link; a context manager.

    Args:
        link: to its machine.
        port: that the router listens on.
    """

    def __init__(self, link, port):
        program = Path(__file__).with_name("far_listener.py")
        self._process = subprocess.Popen(
            [*link.there, sys.executable, program, f"tcp/{link.near}:{port}", *ROBOTS],
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

    def told(self):
        """What became of everything so far, robot by robot."""
        self._process.stdin.write("tell\n")
        self._process.stdin.flush()
        return json.loads(self._process.stdout.readline())

    def hears_everything(self, what):
        """Wait until more has come on every topic of every robot."""
        before = self.told()

        def more():
            now = self.told()
            return all(
                now[robot]["counted"][topic.name] > before[robot]["counted"][topic.name]
                for robot in ROBOTS
                for topic in TOPICS
            )

        eventually(more, START_S, what)


@pytest.fixture
def links():
    """Links to as many far machines."""
    with ExitStack() as stack:
        try:
            entered = [stack.enter_context(Link()) for _ in range(LINKS)]
        except Impossible as reason:
            pytest.skip(str(reason))
        yield entered


@pytest.fixture
def port(links, tmp_path):
    """Of a router on this machine, on every link."""
    number = free_port()
    with Command("router", "--insecure", "--listen", f"tcp/0.0.0.0:{number}", folder=tmp_path) as command:
        command.until(lambda: reachable(f"tcp/127.0.0.1:{number}"), 30.0, "the router listens")
        yield number


@pytest.fixture
def talking(port):
    """Four robots' processes that publish all the time."""
    end = threading.Event()
    buses = {
        (robot, topic): connect(f"tcp/127.0.0.1:{port}", robot, ROLES[topic.name], SystemClock())
        for robot in ROBOTS
        for topic in TOPICS
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


def cut_all(links, lengths):
    """Cut all links at once, each for its time [s]."""
    began = max(link.cut() for link in links)
    for length, link in sorted(zip(lengths, links, strict=True), key=lambda pair: pair[0]):
        time.sleep(max(0.0, began + length - time.monotonic()))
        link.restore()


def test_nothing_counts_under_a_key_that_is_not_its_own(links, port, talking):
    rng = np.random.default_rng(7)
    with ExitStack() as stack:
        listeners = [stack.enter_context(Listener(link, port)) for link in links]
        for listener in listeners:
            listener.hears_everything("everything is heard")
        for lengths in rng.uniform(1.5, 2.5, (CUTS, LINKS)):
            cut_all(links, lengths)
            for listener in listeners:
                listener.hears_everything("everything is heard again")
            time.sleep(WATCHED_S)
        wrong = [wrong for listener in listeners for ear in listener.told().values() for wrong in ear["wrong"]]
    assert wrong == []
