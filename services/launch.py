"""`retouch up`: starts the processes, watches over them, says what happens, stops them cleanly."""

from __future__ import annotations

import argparse
import shutil
import sys
import threading
import time
import webbrowser
from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Self

import msgspec
from rich.console import Console
from rich.live import Live

from protocol import topics
from protocol.messages import Heartbeat, Phase, TeachingState
from services.bus import Subscription
from services.child import EXIT_BAD_INPUT, Child, Job
from services.clock import SystemClock
from services.config import Configuration, save
from services.exceptions import CommandFailed
from services.processes import PROCESS_NAMES
from services.report import Report, attempt_line, attempt_reports, write
from services.runner import stop_on_signals
from services.status import status_table
from services.zenoh_bus import ZenohBus, open_session

POLL_S = 0.1
STOP_S = 2.0
ROUTER = "router"
TEACHER = "teach"


@dataclass(frozen=True)
class Launch:
    """How to run.

    Attributes:
        processes: which to start.
        router: whether to start a router, rather than join one.
        headless: a scripted operator teaches.
        once: end when the loop has closed.
        fresh: start from an empty model, kept in the run's folder.
        json: where to write the report.
        browser: open the page.
    """

    processes: tuple[str, ...] = PROCESS_NAMES
    router: bool = True
    headless: bool = False
    once: bool = False
    fresh: bool = False
    json: Path | None = None
    browser: bool = True

    @classmethod
    def from_arguments(cls, arguments: argparse.Namespace) -> Self:
        """From the command line.

        Raises:
            CommandFailed: --only names a process that does not exist, or the report cannot be written.
        """
        names = tuple(n.strip() for n in arguments.only.split(",")) if arguments.only else PROCESS_NAMES
        for name in names:
            if name not in PROCESS_NAMES:
                raise CommandFailed(f"--only: unknown process {name!r}; there are {', '.join(PROCESS_NAMES)}")
        if arguments.json is not None and not arguments.json.parent.is_dir():
            raise CommandFailed(f"--json: the folder {arguments.json.parent} does not exist")
        if arguments.json is not None and arguments.json.is_dir():
            raise CommandFailed(f"--json: {arguments.json} is a folder; name a file in it")
        return cls(
            processes=names,
            router=arguments.connect is None,
            headless=arguments.headless,
            once=arguments.once,
            fresh=arguments.fresh,
            json=arguments.json,
            browser=not arguments.headless and not arguments.no_browser and "station" in names,
        )


class Voice:
    """Prints the processes' lines with their name in front, and keeps them in the run's log."""

    def __init__(self, console: Console, log: Path) -> None:
        self._console = console
        self._log = log.open("a", encoding="utf-8")
        self._lock = threading.Lock()

    def say(self, name: str, line: str) -> None:
        """One line of a process."""
        with self._lock:
            self._log.write(f"{datetime.now(UTC):%H:%M:%S.%f} {name}: {line}\n")
            self._log.flush()
            self._console.print(f"{name:>10} | {line}", markup=False, highlight=False, soft_wrap=True)

    def close(self) -> None:
        """Close the log."""
        self._log.close()


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


def launch(configuration: Configuration, options: Launch) -> int:
    """Run until interrupted, or until a scripted run has ended; 0 where it did what it was started for.

    Raises:
        ServiceError: it cannot start.
    """
    started = time.monotonic()
    stop = stop_on_signals()
    folder = _run_folder(Path(configuration.viewer.folder))
    configuration = _for_run(configuration, folder, options)
    resolved = folder / "configuration.json"
    save(configuration, resolved)
    console = Console(stderr=False)
    voice = Voice(console, folder / "log.txt")
    children = [Child(job, voice.say) for job in _jobs(options, resolved)]
    supervisor = Supervisor(configuration, options, children, voice.say, started)
    try:
        code = supervisor.run(stop, console)
    finally:
        supervisor.stop()
        voice.close()
    return code


def _run_folder(parent: Path) -> Path:
    stamp = datetime.now(UTC).strftime("%Y%m%d-%H%M%S")
    for suffix in ("", *(f"-{i}" for i in range(2, 100))):
        folder = parent / f"{stamp}{suffix}"
        try:
            folder.mkdir(parents=True)
        except FileExistsError:
            continue
        except OSError as error:
            raise CommandFailed(f"cannot make the folder {folder} for this run: {error.strerror}") from None
        return folder.resolve()
    raise CommandFailed(f"cannot make a folder for this run in {parent}")


def _for_run(configuration: Configuration, folder: Path, options: Launch) -> Configuration:
    viewer = msgspec.structs.replace(configuration.viewer, folder=str(folder))
    model = configuration.model
    if options.fresh:
        model = msgspec.structs.replace(model, database=str(folder / "model.sqlite"))
    return msgspec.structs.replace(configuration, viewer=viewer, model=model)


def _jobs(options: Launch, resolved: Path) -> list[Job]:
    configured = ("--config", str(resolved))
    jobs = [Job(ROUTER, (ROUTER, *configured))] if options.router else []
    jobs += [Job(name, (name, *configured)) for name in options.processes]
    if "model" in options.processes:
        jobs.append(Job(TEACHER, (TEACHER, *configured), restart=False))
    return jobs


class Supervisor:
    """Watches over the children of one run.

    Args:
        configuration: of the run.
        options: how to run.
        children: to start and keep alive.
        say: prints a line of a process.
        started: when the command began, monotonic [s].
    """

    def __init__(
        self,
        configuration: Configuration,
        options: Launch,
        children: list[Child],
        say: Callable[[str, str], None],
        started: float,
    ) -> None:
        self._configuration = configuration
        self._options = options
        self._children = children
        self._say = say
        self._started = started
        self._watch: Watch | None = None
        self._first_motion_s = -1.0
        self._told = 0
        self._phase = ""
        self._browser = options.browser

    def run(self, stop: threading.Event, console: Console) -> int:
        """Poll until the end; the exit code."""
        clock = SystemClock()
        live = Live(console=console, auto_refresh=False) if console.is_terminal and not self._options.headless else None
        if live is not None:
            live.start()
        try:
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
                if teaching is not None and teaching.finished and (self._options.once or self._options.headless):
                    return self._finished(teaching)
                stop.wait(POLL_S)
        finally:
            if live is not None:
                live.stop()
        self._say("retouch", "stopping")
        return self._write_report("interrupted") or 0

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
            if self._options.router and not self._children[0].alive:
                return
            configuration = self._configuration
            try:
                session = open_session(configuration.connect, timeout_s=0.5)
            except Exception:  # noqa: BLE001
                return
            self._watch = Watch(ZenohBus(session, configuration.name, f"supervisor-{id(self)}", SystemClock()))
        self._watch.update()
        if self._first_motion_s < 0.0 and self._watch.moved():
            self._first_motion_s = time.monotonic() - self._started
            self._say("retouch", f"first motion after {self._first_motion_s:.1f} s")
        teaching = self._watch.teaching_state()
        if teaching is None:
            return
        if teaching.phase != self._phase:
            self._phase = teaching.phase
            self._say("teaching", teaching.text)
        for number, attempt in enumerate(teaching.attempts[self._told :], self._told + 1):
            self._say("teaching", attempt_line(number, attempt))
        self._told = max(self._told, len(teaching.attempts))
        if self._browser:
            self._browser = False
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

    def _write_report(self, reason: str) -> int:
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
            first_motion_s=self._first_motion_s,
        )
        if self._options.json is not None:
            write(report, self._options.json)
        return 0 if closed or not self._options.once else 1
