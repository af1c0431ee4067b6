"""A live robot that is flooded, and what becomes of its control periods meanwhile."""

import contextlib
import statistics
import subprocess
import sys
import threading
import time
from pathlib import Path

from protocol import queries, topics
from protocol.messages import AuthorityRenewal, EmergencyStop
from services.bus.bus import Failed
from services.bus.zenoh import connect
from services.process.clock import SystemClock
from tests.system.harness import START_S, Command, eventually, reachable

PROGRAM = Path(__file__).with_name("flooding.py")
ROBOT = "kitchen"
HOLDER = "anna's"
RENEWAL_S = 0.02
AHEAD = ("chrt", "--fifo", "1")
"""The robot and its router come before whatever else the machine does, where that may be said: then only the flood can
take anything from them."""

SLICE_S = 1.5
PAIRS = (3, 12)
"""Slices with the flood and without, at least and at most."""


class Robot:
    """A robot's process with its router, and an operator who has the authority; a context manager.

    Args:
        endpoint: of the router.
        folder: where they run.
        settings: of the configuration, lines of TOML.
        identities: whose certificates are shown; None on a network that knows none.
    """

    def __init__(self, endpoint, folder, settings, identities=None):
        self.endpoint = endpoint
        file = folder / "robot.toml"
        file.write_text(f'name = "{ROBOT}"\nlisten = "{endpoint}"\nconnect = "{endpoint}"\n{settings}\n')
        self._arguments = ("up", "--fresh", "--only", "robot", "--scene", "dishwasher", "--config", file)
        self._folder = folder
        self._identities = identities
        self._stack = contextlib.ExitStack()
        self._end = threading.Event()

    def __enter__(self):
        with contextlib.ExitStack() as stack:
            self.up = stack.enter_context(Command(*self._arguments, folder=self._folder, there=AHEAD))
            self.up.until(lambda: reachable(self.endpoint.replace("tls/", "tcp/")), START_S, "the router listens")
            person = "-anna" if self._identities else ""
            shown = self._identities.of("operator.anna") if self._identities else None
            self._bus = connect(self.endpoint, ROBOT, f"station{person}", SystemClock(), credentials=shown)
            stack.callback(self._bus.close)
            self._beat = self._bus.subscribe(topics.HEARTBEAT)
            self._authority = self._bus.subscribe(topics.AUTHORITY_STATE)
            self._safety = self._bus.subscribe(topics.SAFETY_STATE)
            self.epoch = self.up.until(self._acquired, START_S, "the robot gives the authority")
            holding = threading.Thread(target=self._hold)
            holding.start()
            stack.callback(holding.join)
            stack.callback(self._end.set)
            self._stack = stack.pop_all()
        return self

    def __exit__(self, *_):
        self._stack.close()

    def beat(self):
        """The next heartbeat of the robot's."""
        self._beat.take()
        said = []
        eventually(lambda: said.extend(self._beats()) or said, START_S, "the robot's heartbeat")
        return said[-1]

    def authority(self):
        """Who commands now."""
        self._authority.take()
        return eventually(lambda: self._authority.fresh(SystemClock().now_ns()), START_S, "who commands")

    def stopped_within(self, seconds):
        """Press the stop, as a station does, until the robot says that it is latched."""

        def latched():
            self._bus.publish(topics.EMERGENCY_STOP, EmergencyStop(pressed=True, by="anna", reason="flood"))
            time.sleep(RENEWAL_S)
            state = self._safety.latest()
            return state and state.message.emergency_stop

        eventually(latched, seconds, "the stop is latched")

    def _beats(self):
        return [one.message for one in self._beat.take() if one.message.process == "robot"]

    def _acquired(self):
        request = queries.AcquireAuthority(HOLDER, "anna", request=7)
        answer = eventually(self._bus.ask(queries.ACQUIRE, request).poll, START_S, "an answer")
        return None if isinstance(answer, Failed) else answer.epoch

    def _hold(self):
        while not self._end.wait(RENEWAL_S):
            self._bus.publish(topics.AUTHORITY_RENEWAL, AuthorityRenewal(holder=HOLDER, epoch=self.epoch))


class Flood:
    """The program that floods; a context manager.

    Args:
        kind: of what it sends.
        here: endpoint of the robot's router.
        elsewhere: of one where nobody listens.
        whose: folder and name of the certificate that it shows; nothing where it has none.
    """

    def __init__(self, kind, here, elsewhere, *whose):
        command = [sys.executable, PROGRAM, kind, ROBOT, here, elsewhere, *map(str, whose)]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        assert self._process.stdout.readline() == "flooding\n"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.communicate(timeout=10.0)
        self._process.kill()
        self._process.wait()

    def towards(self, place):
        """Send there from now on; how much was sent to the other place."""
        self._process.stdin.write(f"{place}\n")
        self._process.stdin.flush()
        return int(self._process.stdout.readline())


def missed(before, after):
    """Share of the control periods between two heartbeats that did not begin in time."""
    due = after.rate_hz * (after.stamp_ns - before.stamp_ns) / 1e9
    return 1.0 - ((after.ticks - after.late_ticks) - (before.ticks - before.late_ticks)) / due


class Comparison:
    """Shares of missed periods with a flood and without, slice by slice in turn.

    The flood takes its part of the processor in both: it is sent to the robot, or elsewhere.

    Attributes:
        sent: to the robot, a second.
        without: the mean without.
        more: by how much it is more with, in the mean.
        busier: share of a processor that the robot takes more with.
        error: of that, twice its standard error: how far chance may have brought it.
    """

    def __init__(self, robot, flood, most):
        differences, without, rates, busier = [], [], [], []
        while True:
            quiet, calm = self._slice(robot)
            flood.towards("here")
            began = time.monotonic()
            flooded, busy = self._slice(robot)
            rates.append(flood.towards("elsewhere") / (time.monotonic() - began))
            without.append(quiet)
            differences.append(flooded - quiet)
            busier.append(busy - calm)
            self.sent, self.without = statistics.fmean(rates), statistics.fmean(without)
            self.more, self.busier = statistics.fmean(differences), statistics.fmean(busier)
            if len(differences) < PAIRS[0]:
                continue
            self.error = 2.0 * statistics.stdev(differences) / len(differences) ** 0.5
            if len(differences) >= PAIRS[1] or self.more + self.error < most or self.more - self.error > most:
                return

    def _slice(self, robot):
        """The shares of missed periods, and of a processor."""
        before = robot.beat()
        time.sleep(SLICE_S)
        after = robot.beat()
        return missed(before, after), (after.cpu_s - before.cpu_s) / ((after.stamp_ns - before.stamp_ns) / 1e9)

    def __str__(self):
        return (
            f"{self.sent:.0f} a second: {100 * self.without:.2f} % of the control periods missed without,"
            f" {100 * self.more:+.2f} +- {100 * self.error:.2f} % with, {100 * self.busier:+.0f} % of a processor"
        )
