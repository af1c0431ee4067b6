"""Watches over the processes of a run: keeps them alive, tells what happens, stops them cleanly."""

from __future__ import annotations

import os
import threading
import time
from pathlib import Path

from protocol.messages import TeachingState
from services.bus.zenoh import Lanes, ZenohBus, open_session
from services.certificates.credentials import credentials
from services.commands.up.child import Child
from services.commands.up.network import Narrator, Page, Watch
from services.commands.up.report import Report, attempt_reports, faults_of, write
from services.commands.up.retries import End
from services.commands.up.status import status_table
from services.commands.up.tally import Tally
from services.commands.up.voice import Voice
from services.process.clock import SystemClock
from services.process.config import Configuration
from services.process.exceptions import BusError
from services.process.exit_codes import Exit
from services.process.manager import Manager

POLL_S = 0.1
STOP_S = 2.0
DIAL_S = 10.0
ROUTER = "router"


class Supervisor:
    """Watches over the children of one run.

    Args:
        configuration: of the run.
        children: to start and keep alive; the router first, where there is one.
        voice: says what happens.
        started: when the command began, monotonic [s].
        report: where to write what happened; None for nowhere.
        ends: the run ends when the teaching does.
        page: the operator's, where there is one.
    """

    def __init__(
        self,
        configuration: Configuration,
        children: list[Child],
        voice: Voice,
        *,
        started: float,
        report: Path | None,
        ends: bool,
        page: Page | None,
    ) -> None:
        self._configuration = configuration
        self._children = children
        self._voice = voice
        self._narrator = Narrator(voice.say, started)
        self._report = report
        self._ends = ends
        self._page = page
        self._watch: Watch | None = None
        self._credentials = credentials(configuration, configuration.connect)
        self._manager = Manager()

    def run(self, stop: threading.Event) -> End | None:
        """Poll until the end.

        Args:
            stop: ends the run.

        Returns:
            How it ended; None where it was told to stop.

        Raises:
            CannotWrite: the report has no place.
        """
        clock = SystemClock()
        threading.Thread(target=self._join, args=(stop,), daemon=True).start()
        while not stop.is_set():
            for child in self._children:
                child.poll(clock.now_ns())
            over = next((child.over for child in self._children if child.over is not None), None)
            if over is not None:
                self._write_report(over.line)
                return over
            teaching = self._listen()
            self._manager.alive(clock.now_ns())
            if self._ends and teaching is not None and teaching.finished:
                return self._finished(teaching)
            stop.wait(POLL_S)
        self._voice.say("retouch", "stopping")
        self._write_report("interrupted")
        return None

    def stop(self) -> None:
        """Stop every process; the ones that do not obey are killed."""
        self._manager.stopping()
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

    def _listen(self) -> TeachingState | None:
        if self._watch is None:
            return None
        self._manager.ready()
        self._watch.update()
        self._narrator.tell(self._watch)
        self._voice.table(status_table(self._children, self._watch.beats))
        teaching = self._watch.teaching_state()
        if self._page is not None and teaching is not None:
            self._page.tell(self._voice.say)
        return teaching

    def _join(self, stop: threading.Event) -> None:
        """Enter the network as soon as there is one, on a thread of its own: nobody else waits for it."""
        while not stop.is_set():
            try:
                session = open_session(self._configuration.connect, DIAL_S, credentials=self._credentials)
            except BusError:
                stop.wait(POLL_S)
                continue
            name = f"supervisor-{os.getpid()}"
            self._watch = Watch(ZenohBus(Lanes(session), self._configuration.name, name, SystemClock()))
            return

    def _finished(self, teaching: TeachingState) -> End:
        tally = self._tally(teaching.reason)
        if tally is not None:
            for line in tally.lines():
                self._voice.say("retouch", line)
            self._write_report(teaching.reason)
            return End("", Exit.DONE if tally.complete else Exit.CRASHED)
        if teaching.loop_closed:
            self._voice.say("retouch", f"the loop has closed in {len(self._narrator.attempts)} episodes")
        else:
            self._voice.say("retouch", f"the loop did not close: {teaching.reason}")
        self._write_report(teaching.reason)
        return End("", Exit.DONE if teaching.loop_closed else Exit.CRASHED)

    def _tally(self, reason: str) -> Tally | None:
        """Of a skill's executions, where it is executed and not taught."""
        asked = self._configuration.station.executions
        if not asked:
            return None
        attempts = [(attempt, faults_of(attempt)) for attempt in self._narrator.attempts.values()]
        return Tally.of(self._configuration.model.skill, asked, attempts, reason)

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
            recording_fault=self._watch.recording_fault if self._watch is not None else "",
            attempts=attempt_reports(self._narrator.attempts.values()),
            first_motion_s=self._narrator.first_motion_s,
            executions=self._tally(reason),
        )
        write(report, self._report)
