"""Every process and command ends within two seconds of being told to, whatever has become of its router."""

import os
import signal
import subprocess
import sys
import time

import pytest

from tests.system.harness import START_S, Command, Witness, free_endpoint, reachable

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.alone]

PROMISED_S = 2.0
KERNEL_S = 1.0
"""For the end of a process to be seen, on a machine that is busy with something else too."""

LOADED_S = 0.5


@pytest.fixture
def burner():
    """Two cores' worth of somebody else's work."""
    work = f"import os\nwhile os.getppid() == {os.getpid()}: pass"  # never longer than the test
    burners = [subprocess.Popen([sys.executable, "-c", work]) for _ in range(2)]
    yield
    for one in burners:
        one.kill()
        one.wait()


def ends(command, number=signal.SIGTERM):
    """Tell it to end, and see that it does; its exit code."""
    command.process.send_signal(number)
    return command.ended(PROMISED_S + KERNEL_S)


class Router(Command):
    """A router, and what may become of it."""

    def __init__(self, folder):
        self.endpoint = free_endpoint()
        super().__init__("router", "--listen", self.endpoint, folder=folder)
        self.until(lambda: reachable(self.endpoint), START_S, "the router listens")

    def __exit__(self, *_):
        self.die()  # one that hangs would not hear anything else
        super().__exit__()

    def hang(self):
        """It lives, and does nothing any more; its links fill up."""
        self.process.send_signal(signal.SIGSTOP)

    def die(self):
        """kill -9."""
        self.process.kill()
        self.process.wait()


@pytest.mark.parametrize("becomes", [Router.hang, Router.die], ids=["hangs", "is dead"])
@pytest.mark.parametrize("name", ["master", "model"])
def test_a_process_whose_router_is_lost_ends(tmp_path, burner, becomes, name):
    with (
        Router(tmp_path) as router,
        Command(name, "--connect", router.endpoint, folder=tmp_path) as process,
        Witness(router.endpoint) as witness,
    ):
        witness.next_beats({name}, START_S)
        becomes(router)
        time.sleep(LOADED_S)  # so long its links fill up
        assert ends(process) == 0, process.tail()


waiting = pytest.mark.parametrize(
    ("arguments", "code"),
    [(("master",), 0), (("echo", "**"), 130), (("top",), 130), (("stop",), 130)],
    ids=["master", "echo", "top", "stop"],
)
"""A process obeys; a command that was started for something is interrupted."""


@waiting
def test_what_waits_for_a_router_ends(tmp_path, burner, arguments, code):
    with Command(*arguments, "--connect", free_endpoint(), folder=tmp_path) as command:
        command.until(lambda: "waiting for a router" in command.err, START_S, "it waits")
        assert ends(command) == code, command.tail()


@waiting
def test_what_dials_a_router_that_hangs_ends(tmp_path, arguments, code):
    with Router(tmp_path) as router:
        router.hang()
        with Command(*arguments, "--connect", router.endpoint, folder=tmp_path) as command:
            command.until(lambda: "does not answer as a router" in command.err, START_S, "it waits")
            assert ends(command) == code, command.tail()


@pytest.mark.parametrize("after_s", [0.0, 0.1, 0.3, 0.6, 1.0])
def test_a_process_that_is_told_while_it_begins_ends(tmp_path, router, burner, after_s):
    with Command("viewer", "--connect", router, folder=tmp_path) as beginning:
        time.sleep(after_s)  # it imports, dials or builds, whichever it is then
        ends(beginning)
