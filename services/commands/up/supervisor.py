"""Watches over the processes of a run: keeps them alive, tells what happens, stops them cleanly."""

from __future__ import annotations

import contextlib
import os
import shutil
import sys
import threading
import time
import webbrowser
from collections.abc import Callable
from pathlib import Path

from rich.console import Console
from rich.live import Live

from protocol import topics
from protocol.messages import Heartbeat, Phase, TeachingState
from services.bus.bus import Subscription
from services.bus.zenoh import ZenohBus, open_session
from services.commands.up.child import EXIT_BAD_INPUT, Child
from services.commands.up.report import Report, attempt_line, attempt_reports, write
from services.commands.up.status import status_table
from services.process.clock import SystemClock
from services.process.config import Configuration
from services.process.exceptions import BusError

POLL_S = 0.1
STOP_S = 2.0
ROUTER = "router"

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
        self.robot = bus.subscribe(topics.ROBOT_STATE)
        self.recording = bus.subscribe(topics.RECORDING)
        self._heartbeats: Subscription[Heartbeat] = bus.subscribe(topics.HEARTBEAT)
        self.beats: dict[str, Heartbeat] = {}

    def update(self) -> None:
        """Take what has come."""
        for received in self._heartbeats.take():
            self.beats[received.message.process] = received.message

    def teaching_state(self) -> TeachingState | None:
        """The newest state of the workflow."""
        received = self.teaching.latest()
        return received.message if received is not None else None

    def moved(self) -> bool:
        """Whether the robot is in motion."""
        received = self.robot.latest()
        return received is not None and received.message.phase in (Phase.RAMP, Phase.EXECUTE)

    def close(self) -> None:
        """Leave the network."""
        self._bus.close()


class Narrator:
    """Tells a person what happens, each thing once.

    Args:
        say: prints a line.
        started: when the command began, monotonic [s].
    """

    def __init__(self, say: Say, started: float) -> None:
        self.first_motion_s = -1.0
        self._say = say
        self._started = started
        self._phase = ""
        self._told = 0

    def tell(self, watch: Watch) -> None:
        """What is new."""
        if self.first_motion_s < 0.0 and watch.moved():
            self.first_motion_s = time.monotonic() - self._started
            self._say("retouch", f"first motion after {self.first_motion_s:.1f} s")
        teaching = watch.teaching_state()
        if teaching is None:
            return
        if teaching.phase != self._phase:
            self._phase = teaching.phase
            self._say("teaching", teaching.text)
        for number, attempt in enumerate(teaching.attempts[self._told :], self._told + 1):
            self._say("teaching", attempt_line(number, attempt))
        self._told = max(self._told, len(teaching.attempts))


class Supervisor:
    """Watches over the children of one run.

    Args:
        configuration: of the run.
        children: to start and keep alive; the router first, where there is one.
        say: prints a line of a process.
        started: when the command began, monotonic [s].
        report: where to write what happened; None for nowhere.
        ends: the run ends when the teaching does.
        interrupted: exit code of a run that a person ended before.
        browser: open the operator's page when it is there.
    """

    def __init__(
        self,
        configuration: Configuration,
        children: list[Child],
        say: Say,
        *,
        started: float,
        report: Path | None,
        ends: bool,
        interrupted: int,
        browser: bool,
    ) -> None:
        self._configuration = configuration
        self._children = children
        self._say = say
        self._narrator = Narrator(say, started)
        self._report = report
        self._ends = ends
        self._interrupted = interrupted
        self._browser = browser
        self._watch: Watch | None = None

    def run(self, stop: threading.Event, console: Console, *, table: bool) -> int:
        """Poll until the end; the exit code.

        Args:
            stop: ends the run.
            console: where the live table is drawn.
            table: whether to draw it.
        """
        clock = SystemClock()
        with Live(console=console, auto_refresh=False) if table else contextlib.nullcontext() as live:
            while not stop.is_set():
                for child in self._children:
                    child.poll(clock.now_ns())
                failed = next((child for child in self._children if child.gave_up), None)
                if failed is not None:
                    return self._given_up(failed)
                self._listen()
                if live is not None and self._watch is not None:
                    live.update(status_table(self._children, self._watch.beats), refresh=True)
                teaching = self._watch.teaching_state() if self._watch is not None else None
                if self._ends and teaching is not None and teaching.finished:
                    return self._finished(teaching)
                stop.wait(POLL_S)
        self._say("retouch", "stopping")
        self._write_report("interrupted")
        return self._interrupted

    def stop(self) -> None:
        """Stop every process; the ones that do not obey are killed."""
        if self._watch is not None:
            self._watch.close()
        # The router goes last: a process that leaves the network cleanly needs it.
        routers = [child for child in self._children if child.job.name == ROUTER]
        for group in ([child for child in self._children if child not in routers], routers):
            for child in group:
                child.terminate()
            deadline = time.monotonic() + STOP_S
            for child in group:
                child.wait(max(0.05, deadline - time.monotonic()))

    def _listen(self) -> None:
        if self._watch is None:
            self._watch = self._join()
        if self._watch is None:
            return
        self._watch.update()
        self._narrator.tell(self._watch)
        if self._browser and self._watch.teaching_state() is not None:
            self._browser = False
            self._open_page()

    def _join(self) -> Watch | None:
        if not self._children[0].alive:
            return None
        try:
            session = open_session(self._configuration.connect, timeout_s=0.5)
        except BusError:
            return None
        name = f"supervisor-{os.getpid()}"
        return Watch(ZenohBus(session, self._configuration.name, name, SystemClock()))

    def _open_page(self) -> None:
        station = self._configuration.station
        url = f"http://{station.host}:{station.port}/"
        self._say("retouch", f"the operator's page is {url}")
        if shutil.which("xdg-open") or sys.platform == "darwin":
            webbrowser.open(url)

    def _given_up(self, child: Child) -> int:
        line = child.last_line.removeprefix("retouch: ") or f"ended with code {child.exit_code}"
        self._write_report(f"{child.job.name}: {line}")
        sys.stderr.write(f"retouch: {child.job.name}: {line}\n")
        return EXIT_BAD_INPUT

    def _finished(self, teaching: TeachingState) -> int:
        if teaching.loop_closed:
            self._say("retouch", f"the loop has closed in {len(teaching.attempts)} episodes")
        else:
            self._say("retouch", f"the loop did not close: {teaching.reason}")
        self._write_report(teaching.reason)
        return 0 if teaching.loop_closed else 1

    def _write_report(self, reason: str) -> None:
        if self._report is None:
            return
        teaching = self._watch.teaching_state() if self._watch is not None else None
        recording = self._watch.recording.latest() if self._watch is not None else None
        closed = teaching is not None and teaching.loop_closed
        report = Report(
            loop_closed=closed,
            reason="" if closed else reason,
            processes={c.job.name: c.pid for c in self._children if c.pid is not None and c.job.restart},
            restarts={c.job.name: c.restarts for c in self._children},
            recording=recording.message.path if recording is not None else "",
            attempts=attempt_reports(teaching),
            first_motion_s=self._narrator.first_motion_s,
        )
        write(report, self._report)
