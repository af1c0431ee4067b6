"""What a supervisor hears of its robot's network, and what it tells people of it."""

from __future__ import annotations

import time
from collections.abc import Callable

from protocol import topics
from protocol.messages import Attempt, Heartbeat, TeachingState
from services.bus.subscription import Subscription
from services.bus.zenoh import ZenohBus
from services.certificates.page import address
from services.commands.opening import open_in_browser
from services.commands.up.report import attempt_line
from services.process.addresses import EVERYWHERE
from services.process.config import StationSection
from services.process.repeats import Repeats

Say = Callable[[str, str], None]
"""Prints a line under a name."""


class Watch:
    """What the supervisor hears of the network.

    Args:
        bus: a session of its own.
    """

    def __init__(self, bus: ZenohBus) -> None:
        self._bus = bus
        self.teaching = bus.subscribe(topics.TEACHING_STATE)
        self.execution = bus.subscribe(topics.EXECUTION)
        self.recording = bus.subscribe(topics.RECORDING)
        self._heartbeats: Subscription[Heartbeat] = bus.subscribe(topics.HEARTBEAT)
        self.beats: dict[str, Heartbeat] = {}
        self.recording_fault = ""

    def update(self) -> None:
        """Take what has come."""
        recording = self.recording.latest()
        if recording is not None and recording.message.fault:
            self.recording_fault = recording.message.fault
        for received in self._heartbeats.take():
            self.beats[received.message.process] = received.message

    def teaching_state(self) -> TeachingState | None:
        """The newest state of the workflow."""
        received = self.teaching.latest()
        return received.message if received is not None else None

    def moved(self) -> bool:
        """Whether the robot has begun a motion."""
        return self.execution.latest() is not None

    def close(self) -> None:
        """Leave the network."""
        self._bus.close()


class Narrator:
    """Tells a person what happens, each thing once.

    Args:
        say: prints a line.
        started: when the command began, monotonic [s].

    Attributes:
        first_motion_s: from the start to the robot's first motion [s]; negative where it never moved.
        attempts: every episode of the run, by the station process that told it and its number there: a station tells of
            its newest only, and one that was restarted counts anew.
    """

    def __init__(self, say: Say, started: float) -> None:
        self.first_motion_s = -1.0
        self.attempts: dict[tuple[int, int], Attempt] = {}
        self._say = say
        self._started = started
        self._phase = ""
        self._repeats = Repeats()

    def tell(self, watch: Watch) -> None:
        """What is new."""
        if self.first_motion_s < 0.0 and watch.moved():
            self.first_motion_s = time.monotonic() - self._started
            self._say("retouch", f"first motion after {self.first_motion_s:.1f} s")
        teaching = watch.teaching_state()
        if teaching is None:
            return
        now_s = time.monotonic()
        lines = self._repeats.due(now_s)
        if teaching.phase != self._phase:
            self._phase = teaching.phase
            lines += self._repeats.told(teaching.told, now_s)
        for line in lines:
            self._say("teaching", line)
        for attempt in teaching.attempts:
            told = (teaching.publisher, attempt.number)
            if told not in self.attempts:
                self.attempts[told] = attempt
                self._say("teaching", attempt_line(len(self.attempts), attempt))


class Page:
    """The operator's page, told and opened once it is there.

    Args:
        section: says where it is served, and under which certificate.
        opens: in a browser of this machine, where there is one.
    """

    def __init__(self, section: StationSection, *, opens: bool) -> None:
        self.url = address(section, EVERYWHERE.get(section.host, section.host))
        self._opens = opens
        self._told = False

    def tell(self, say: Say) -> None:
        """Where it is, and what it waits for."""
        if self._told:
            return
        self._told = True
        say("retouch", f"the operator's page is {self.url}; the robot stands until somebody presses a button there")
        if self._opens:
            open_in_browser(self.url)
