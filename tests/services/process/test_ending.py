"""How a process ends, whatever it is doing when it is told to."""

import contextlib
import os
import signal
import subprocess
import sys

import pytest

BUSY = """
import signal, sys, time
from services.process.ending import end_within
signal.signal(signal.SIGTERM, lambda *_: None)
patience = end_within({seconds})
patience.seconds = {then}
print("told", flush=True)
while True:
    time.sleep(60.0)
"""


@pytest.fixture
def busy():
    """A function that starts a process which goes on when it is told to end; it has so much time for that."""
    started = []

    def busy_(seconds, then, stderr=subprocess.PIPE):
        script = BUSY.format(seconds=seconds, then=then)
        started.append(subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=stderr))
        assert started[-1].stdout.readline() == b"told\n"
        return started[-1]

    yield busy_
    for process in started:
        process.kill()
        process.communicate()


@pytest.fixture
def full_pipe():
    """A pipe that takes nothing more, since nobody reads it."""
    out, into = os.pipe()
    os.set_blocking(into, False)
    with contextlib.suppress(BlockingIOError):
        while True:
            os.write(into, b"\n")
    os.set_blocking(into, True)
    yield into
    os.close(into)
    os.close(out)


def test_what_has_nothing_to_finish_ends_at_once_and_is_done(busy):
    process = busy(0.0, 0.0)
    process.send_signal(signal.SIGTERM)
    assert process.wait(30.0) == 0
    assert process.stderr.read() == b""


def test_what_has_something_to_finish_and_hangs_is_ended_by_force_and_says_so(busy):
    process = busy(0.0, 0.05)
    process.send_signal(signal.SIGTERM)
    assert process.wait(30.0) == 1
    assert b"ended by force" in process.stderr.read()


def test_nobody_who_reads_is_no_reason_to_stay(busy, full_pipe):
    process = busy(0.0, 0.05, stderr=full_pipe)
    process.send_signal(signal.SIGTERM)
    assert process.wait(30.0) == 1
