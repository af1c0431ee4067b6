"""A robot's site on this machine and an operator's desk on the far one, of real processes, and ears on both sides."""

import contextlib
import subprocess
import sys
from pathlib import Path

import msgpack
import psutil

from protocol import topics
from protocol.messages import Coding
from tests.network.ear import NEAR, Ear
from tests.network.link import Link
from tests.ports import free_port
from tests.system.harness import START_S, Command, eventually, reachable

SCENE = "particle"
AUTONOMOUS_S = 4.0
REFINE_S = 14.0
_HERE = Path(__file__).parent


class Sites:
    """Both sites; a context manager.

    Args:
        link: between them.
        folder: where they run.
        pictures: how two cameras code what they send; None without any.
        router: the desk has a router of its own, which joins the robot's.

    Attributes:
        ear: at the robot's site.
        desk: the operator's command, which teaches until the loop has closed.
    """

    def __init__(self, link: Link, folder: Path, *, pictures: Coding | None, router: bool = False) -> None:
        self._link = link
        self._folder = folder
        self._pictures = pictures
        self._router = router
        self._stack = contextlib.ExitStack()

    def __enter__(self):
        port = free_port()
        here, endpoint = f"tcp/127.0.0.1:{port}", f"tcp/{self._link.near}:{port}"
        near, far = self._folder / "near", self._folder / "far"
        near.mkdir()
        far.mkdir()
        with contextlib.ExitStack() as stack:
            arguments = ("--fresh", "--only", "robot,model", "--scene", SCENE)
            arguments += ("--insecure", "--listen", f"tcp/0.0.0.0:{port}")
            robot = stack.enter_context(Command("up", *arguments, folder=near))
            robot.until(lambda: reachable(here), START_S, "the router listens")
            self.ear = stack.enter_context(Ear(here, NEAR))
            if self._pictures is not None:
                stack.enter_context(running([sys.executable, _HERE / "pictures.py", here, self._pictures.value]))
            if self._router:
                endpoint = stack.enter_context(self._joined(endpoint, far))
            program = [*self._link.there, sys.executable, _HERE / "ear.py", endpoint, self._far_file]
            self._far_ear = stack.enter_context(running(program))
            assert self._far_ear.stdout.readline() == "listening\n"
            self.desk = stack.enter_context(self._operator(endpoint, far))
            self._stack = stack.pop_all()
        return self

    def __exit__(self, *_):
        self._stack.close()

    @property
    def _far_file(self):
        return self._folder / "far.ear"

    @contextlib.contextmanager
    def _joined(self, endpoint, folder):
        """A router on the far machine; its endpoint there."""
        there = f"tcp/127.0.0.1:{free_port()}"
        arguments = ("router", "--insecure", "--listen", there, "--connect", endpoint)
        with Command(*arguments, folder=folder, there=self._link.there) as router:
            router.until(lambda: "listening" in router.err, START_S, "the desk's router listens")
            yield there

    def _operator(self, endpoint, folder):
        settings = folder / "desk.toml"
        settings.write_text(f"[station]\nautonomous_s = {AUTONOMOUS_S}\nrefine_s = {REFINE_S}\n")
        arguments = ["--headless", "--once", "--only", "master,station", "--scene", SCENE]
        arguments += ["--insecure", "--connect", endpoint, "--config", settings, "--json", folder / "out.json"]
        return Command("up", *arguments, folder=folder, there=self._link.there)

    def closes(self, within_s):
        """Whether the loop has closed within the time [s]."""
        with contextlib.suppress(AssertionError):
            return self.desk.ended(within_s) == 0
        return False

    def refining(self, progress):
        """Wait until a refinement has come so far."""
        eventually(lambda: self._refines(progress), START_S, "a refinement is under way")

    def _refines(self, progress):
        state = next(
            (payload for _, name, payload in reversed(self.ear.heard) if name == topics.ROBOT_STATE.name), None
        )
        if state is None:
            return False
        fields = msgpack.unpackb(state)
        return fields["mode"] == "refine" and fields["phase"] == "execute" and fields["progress"] > progress

    @contextlib.contextmanager
    def asleep(self):
        """The desk's processes stand still."""
        sleepers = self.desk.left()
        for process in sleepers:
            process.suspend()
        try:
            yield
        finally:
            for process in sleepers:
                with contextlib.suppress(psutil.NoSuchProcess):
                    process.resume()

    def heard(self):
        """What was heard at the robot's site, and what at the desk."""
        self._far_ear.stdin.close()
        self._far_ear.wait(START_S)
        return self.ear.heard, msgpack.unpackb(self._far_file.read_bytes())


@contextlib.contextmanager
def running(command):
    """A program of the tests' own."""
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    try:
        yield process
    finally:
        process.kill()
        process.wait()
        with contextlib.suppress(BrokenPipeError):
            process.stdin.close()
        process.stdout.close()
