"""Real `retouch` commands in folders of their own, and a witness on their network.

Nothing here waits for a fixed time: every wait is for something that is seen, and has a deadline.
"""

import contextlib
import os
import secrets
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import psutil

from protocol import topics
from protocol.queries import Refused
from services.bus.bus import Failed
from services.bus.zenoh import Lanes, ZenohBus, open_session
from services.process.clock import SystemClock
from services.process.processes import PROCESS_NAMES
from tests.ports import free_port

POLL_S = 0.01
START_S = 120.0
"""A whole system is up within this time, on a machine that is busy with something else too."""

MARK = "RETOUCH_SYSTEM_TEST"
"""Stands in the environment of everything that a command starts, so that nothing of it is overlooked."""

EVERYBODY = {"router", *PROCESS_NAMES}

STATES = (topics.ROBOT_STATE, topics.TEACHING_STATE, topics.AUTHORITY_STATE, topics.SAFETY_STATE, topics.MODEL_STATE)
"""What a witness hears, of processes on this machine."""


def eventually(seen, within_s, what):
    """The first true value of `seen()`; `what` is waited for, as text or as a function that gives it."""
    deadline = time.monotonic() + within_s
    while not (value := seen()):
        if time.monotonic() > deadline:
            raise AssertionError(f"not within {within_s:g} s: {what() if callable(what) else what}")
        time.sleep(POLL_S)
    return value


def free_endpoint():
    """A Zenoh endpoint where nobody listens."""
    return f"tcp/127.0.0.1:{free_port()}"


def reachable(endpoint):
    """Whether somebody listens at the endpoint."""
    host, port = endpoint.removeprefix("tcp/").rsplit(":", 1)
    try:
        socket.create_connection((host, int(port)), timeout=1.0).close()
    except OSError:
        return False
    return True


def configured(folder, endpoint, *, top="", **sections):
    """A configuration file whose ports are all free; returns its path.

    Args:
        folder: to write it in.
        endpoint: of the router.
        top: lines before the first section.
        sections: lines to add to a section, by its name.
    """
    sections["station"] = f"port = {free_port()}\n" + sections.get("station", "")
    sections["viewer"] = f"web_port = {free_port()}\nstream_port = {free_port()}\n" + sections.get("viewer", "")
    head = f'listen = "{endpoint}"\nconnect = "{endpoint}"\n{top}\n'
    path = folder / "retouch.toml"
    path.write_text(head + "".join(f"[{name}]\n{lines}\n" for name, lines in sections.items()))
    return path


class Command:
    """A running `retouch` command; a context manager that leaves nothing of it behind.

    Args:
        arguments: of the command.
        folder: where it runs and where its output is kept.
        environment: variables to set besides.
        shell: redirections of its streams, as bash writes them.
        there: what to put before it so that it runs on another machine.
    """

    def __init__(self, *arguments, folder, environment=None, shell="", there=()):
        self.mark = secrets.token_hex(8)
        self._out = folder / f"{self.mark}.out"
        self._err = folder / f"{self.mark}.err"
        environment = {
            **os.environ,
            "XDG_DATA_HOME": str(folder / "data"),
            "XDG_STATE_HOME": str(folder / "state"),
            MARK: self.mark,
            **(environment or {}),
        }
        with self._out.open("wb") as out, self._err.open("wb") as err:
            command = [*there, str(Path(sys.executable).with_name("retouch")), *map(str, arguments)]
            self.process = subprocess.Popen(
                ["bash", "-c", f'exec "$@" {shell}', "bash", *command] if shell else command,
                cwd=folder,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=err,
                start_new_session=True,
            )

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()

    @property
    def out(self):
        """Standard output so far."""
        return self._out.read_text(errors="replace")

    @property
    def err(self):
        """Standard error so far."""
        return self._err.read_text(errors="replace")

    def until(self, seen, within_s, what):
        """As `eventually`; fails at once where the command ends instead."""

        def seen_or_ended():
            value = seen()
            if not value and self.process.poll() is not None:
                raise AssertionError(f"ended with {self.process.returncode} before: {what}\n{self.tail()}")
            return value

        try:
            return eventually(seen_or_ended, within_s, what)
        except AssertionError as error:
            raise AssertionError(f"{error}\n{self.tail()}") from None

    def ended(self, within_s):
        """Wait for its end; the exit code."""
        try:
            return self.process.wait(within_s)
        except subprocess.TimeoutExpired:
            raise AssertionError(f"did not end within {within_s:g} s\n{self.tail()}") from None

    def tail(self):
        """The end of what it said, for people."""
        return f"--- stdout\n{self.out[-4000:]}\n--- stderr\n{self.err[-2000:]}"

    def left(self):
        """What lives of it and of everything that it started, orphans included."""
        marked = f"{MARK}={self.mark}".encode()
        return [process for number in _numbers() if marked in _environment(number) and (process := _process(number))]

    def pids(self):
        """Name to process id of what a supervisor started and what lives now."""
        children = [process for process in self.left() if process.pid != self.process.pid]
        return {name: process.pid for process in children if (name := _command_name(process)) in EVERYBODY}

    def kill(self, name):
        """kill -9 one of a supervisor's processes; its process id."""
        pid = self.pids()[name]
        os.kill(pid, signal.SIGKILL)
        return pid

    def stop(self, within_s=10.0):
        """SIGTERM, and SIGKILL for what does not obey; returns the exit code."""
        if self.process.poll() is None:
            self.process.terminate()
            try:
                self.process.wait(within_s)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        for process in self.left():
            with contextlib.suppress(psutil.NoSuchProcess):  # it may have ended since it was seen
                process.kill()
        return self.process.returncode


def _numbers():
    return [int(name) for name in os.listdir("/proc") if name.isdigit()]  # noqa: PTH208 (looked at again and again)


def _environment(number):
    """Its variables; none of what has ended, or is somebody else's."""
    try:
        return Path(f"/proc/{number}/environ").read_bytes().split(b"\0")
    except OSError:
        return []


def _process(number):
    try:
        return psutil.Process(number)
    except psutil.Error:
        return None


def _command_name(process):
    """The first argument of `retouch` that is no flag."""
    try:
        arguments = process.cmdline()
    except psutil.Error:
        return ""
    after = next((i for i, argument in enumerate(arguments) if argument.endswith("services/__main__.py")), None)
    return next((argument for argument in arguments[after:] if argument in EVERYBODY), "") if after else ""


class Witness:
    """Hears one robot's network, and asks, as any process could; a context manager.

    Args:
        endpoint: of the router.
        robot: the robot's name.
    """

    def __init__(self, endpoint, robot="robot1"):
        session = open_session(endpoint, START_S)
        self.bus = ZenohBus(Lanes(session), robot, f"witness-{secrets.token_hex(4)}", SystemClock())
        self._states = {topic: self.bus.subscribe(topic) for topic in STATES}
        self._heartbeats = self.bus.subscribe(topics.HEARTBEAT)
        self._beats = {}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.bus.close()

    @property
    def robot(self):
        """The robot's fresh state, or None."""
        return self._fresh(topics.ROBOT_STATE)

    @property
    def teaching(self):
        """The workflow's fresh state, or None."""
        return self._fresh(topics.TEACHING_STATE)

    @property
    def authority(self):
        """Who may command, or None."""
        return self._fresh(topics.AUTHORITY_STATE)

    def _fresh(self, topic):
        return self._states[topic].fresh(SystemClock().now_ns())

    def next(self, topic, seen=lambda state: True, within_s=10.0):
        """The first of a process' states that is sent after this call and of which `seen` is true.

        What was heard on another topic says nothing of whether this one's newest has come.
        """
        called_ns = SystemClock().now_ns()

        def sent_since():
            state = self._fresh(topic)
            return state if state is not None and state.stamp_ns > called_ns and seen(state) else None

        return eventually(sent_since, within_s, f"the next {topic.name}")

    def beats(self):
        """The newest heartbeat of each process."""
        for received in self._heartbeats.take():
            self._beats[received.message.process] = received.message
        return dict(self._beats)

    def next_beats(self, names, within_s=10.0):
        """Heartbeats of all these processes, each sent after this call."""
        self.beats()
        self._beats = {}
        return eventually(
            lambda: beats if set(names) <= set(beats := self.beats()) else None,
            within_s,
            lambda: f"heartbeats of {sorted(names)}, only {sorted(self._beats)} came",
        )

    def ask(self, query, request, within_s=5.0):
        """The answer."""
        pending = self.bus.ask(query, request, within_s)
        return eventually(pending.poll, within_s + 1.0, f"an answer to {query.name}")

    def asked(self, query, request, within_s=20.0):
        """The positive answer; asked again until there is one."""

        def answer():
            outcome = self.ask(query, request)
            return None if isinstance(outcome, Failed | Refused) else outcome

        return eventually(answer, within_s, f"a positive answer to {query.name}")
