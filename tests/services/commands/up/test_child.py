"""A supervised process comes back, later each time; one that cannot start says why and is left alone."""

import os
import signal
import time

import pytest

from services.commands.up.child import Child, Job
from services.commands.up.retries import BACK_OFF_S, STEADY_AFTER_S
from services.process.exit_codes import Exit

START_NS = 10**9
WITHIN_S = 10.0


class Said:
    """What the children said."""

    def __init__(self):
        self.lines = []

    def __call__(self, name, line):
        self.lines.append((name, line))


@pytest.fixture
def said():
    return Said()


@pytest.fixture
def child_of(said):
    """A function that makes the child of a job, and ends it after the test."""
    children = []

    def make(*arguments, restart=True):
        children.append(Child(Job("worker", arguments, restart), said))
        return children[-1]

    yield make
    for child in children:
        child.terminate()
        child.wait(WITHIN_S)


def gone(child, now_ns):
    """Poll at the same moment until the death of the process is noticed."""
    deadline = time.monotonic() + WITHIN_S
    while child.alive:
        assert time.monotonic() < deadline, "its death was not noticed"
        time.sleep(0.002)
        child.poll(now_ns)


def killed(child, now_ns):
    """kill -9, noticed at this moment; the process id that it had."""
    pid = child.pid
    os.kill(pid, signal.SIGKILL)
    gone(child, now_ns)
    return pid


def test_a_killed_process_comes_back_as_another_one_and_waits_longer_each_time(child_of, said):
    child, now_ns = child_of("router"), START_NS
    child.poll(now_ns)
    for count, delay_s in enumerate((*BACK_OFF_S, BACK_OFF_S[-1]), 1):
        pid = killed(child, now_ns)
        assert said.lines[-1] == ("worker", f"was killed by signal 9; starts again in {delay_s:g} s")
        assert child.restarts == count
        child.poll(now_ns + round(0.99 * delay_s * 1e9))
        assert not child.alive
        now_ns += round(delay_s * 1e9)
        child.poll(now_ns)
        assert child.pid not in (None, pid)


def test_one_that_ran_steadily_comes_back_at_once(child_of, said):
    child, now_ns = child_of("router"), START_NS
    child.poll(now_ns)
    killed(child, now_ns)
    now_ns += round(BACK_OFF_S[0] * 1e9)
    child.poll(now_ns)
    killed(child, now_ns + round((STEADY_AFTER_S + 0.1) * 1e9))
    assert said.lines[-1][1].endswith(f"starts again in {BACK_OFF_S[0]:g} s")


@pytest.mark.system
def test_one_that_cannot_start_says_why_and_is_left_alone(child_of, said):
    child = child_of("frobnicate")
    child.poll(START_NS)
    gone(child, START_NS)
    assert child.over.code == Exit.BAD_INPUT
    assert "frobnicate" in child.over.line
    assert "frobnicate" in child.last_line
    assert said.lines == [("worker", child.last_line)]
    child.poll(START_NS + 10**12)
    assert not child.alive
    assert child.restarts == 0


@pytest.mark.system
def test_a_task_is_done_when_it_ends_with_0_but_not_when_it_is_killed(child_of):
    task = child_of("topics", restart=False)
    task.poll(START_NS)
    killed(task, START_NS)
    assert task.over is None
    now_ns = START_NS + round(BACK_OFF_S[0] * 1e9)
    task.poll(now_ns)
    gone(task, now_ns)
    assert task.exit_code == 0
    assert task.over is None
    task.poll(now_ns + 10**12)
    assert not task.alive
    assert task.restarts == 1


def test_what_does_not_obey_is_killed_and_what_was_told_to_end_stays_away(child_of, said):
    child = child_of("router")
    child.poll(START_NS)
    pid = child.pid
    os.kill(pid, signal.SIGSTOP)
    os.waitpid(pid, os.WUNTRACED)  # it has stopped: signals sent at once would be delivered in any order
    child.terminate()
    child.wait(0.05)
    assert said.lines[-1] == ("worker", "did not stop in time and was killed")
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)
    child.poll(START_NS + 10**12)
    assert not child.alive
