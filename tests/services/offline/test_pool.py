"""The same work on every item, here and in processes of its own."""

import logging
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from services.offline import pool
from services.offline.pool import ProcessDied, each, overall
from services.process.exceptions import CommandFailed
from tests.system.harness import eventually


def nested(number, progress):
    return [half for _, (half, _) in sorted(each(halve, [number, 2 * number], 2))]


def die(number, progress):
    os.kill(os.getpid(), signal.SIGKILL) if number == 1 else time.sleep(0.01)


def halve(number, progress):
    progress(0.5)
    if number < 0:
        raise CommandFailed(f"{number} cannot be halved")
    return number / 2, os.getpid()


@pytest.mark.parametrize("jobs", [1, pytest.param(2, marks=pytest.mark.system)])
def test_every_item_has_its_result_and_the_progress_grows_to_one(jobs):
    shares = []
    results = dict(each(halve, [2, 4, 6], jobs, overall(3, shares.append)))
    assert {number: half for number, (half, _) in results.items()} == {0: 1.0, 1: 2.0, 2: 3.0}
    apart = {process for _, process in results.values()} - {os.getpid()}
    assert bool(apart) == (jobs > 1)
    assert shares == sorted(shares)
    assert shares[-1] == pytest.approx(1.0)


@pytest.mark.parametrize("jobs", [1, pytest.param(2, marks=pytest.mark.system)])
def test_an_error_comes_back_as_itself(jobs):
    with pytest.raises(CommandFailed, match="-3 cannot be halved"):
        list(each(halve, [2, -3, 6], jobs))


def test_an_item_is_told_to_begin_and_to_end_even_if_it_says_nothing():
    told = []
    list(each(halve, [2, 4], 1, lambda *report: told.append(report)))
    assert told == [(0, 0.0), (0, 0.5), (0, 1.0), (1, 0.0), (1, 0.5), (1, 1.0)]


def speak(number, progress):
    logging.getLogger("services.work").info("at %d", number)
    logging.getLogger("services.work").warning("beware of %d", number)


def test_what_is_done_here_says_no_more_than_in_another_process(caplog):
    """Beside the progress only what is wrong; whoever shared it out says what they like."""
    caplog.set_level(logging.INFO)
    for number, _ in each(speak, [2, 4], 1):
        logging.getLogger("services.command").info("%d is done", number)
    assert [record.getMessage() for record in caplog.records] == [
        "beware of 2",
        "0 is done",
        "beware of 4",
        "1 is done",
    ]


@pytest.mark.system
def test_a_process_of_the_pool_starts_no_processes_itself():
    assert dict(each(nested, [2, 4], 2)) == {0: [1.0, 2.0], 1: [2.0, 4.0]}


@pytest.mark.system
def test_a_killed_process_ends_the_work_in_one_line_and_the_pool_works_again():
    with pytest.raises(ProcessDied):
        list(each(die, [0, 1, 2, 3], 2))
    assert len(list(each(halve, [2, 4], 2))) == 2


@pytest.mark.system
def test_a_closed_iterator_leaves_no_process():
    results = each(halve, [2] * 50, 2)
    next(results)
    results.close()
    children = Path(f"/proc/{os.getpid()}/task/{os.getpid()}/children").read_text().split()
    running = [Path(f"/proc/{child}/cmdline").read_bytes() for child in children]
    assert [line for line in running if b"loky" in line and b"resource_tracker" not in line] == []


@pytest.mark.system
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_what_interrupts_while_the_processes_are_started_comes_once_they_all_are(monkeypatch, number):
    """Whichever thread it reaches: there is one that listens to the processes."""
    begun = []

    class Interrupted(pool.Parallel):
        def __call__(self, tasks):
            started = threading.Thread(target=os.kill, args=(os.getpid(), number))
            started.start()
            started.join()
            results = super().__call__(tasks)
            begun.append(self)
            return results

    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(pool, "Parallel", Interrupted)
    before = signal.signal(number, interrupt)
    try:
        with pytest.raises(KeyboardInterrupt):
            next(each(halve, [2, 4, 6], 2))
        assert begun
        assert signal.getsignal(number) is interrupt
    finally:
        signal.signal(number, before)
    monkeypatch.undo()
    assert len(dict(each(halve, [2, 4], 2))) == 2


KILLED = """
import os, sys, time
from services.offline.pool import each
from tests.services.offline.test_pool import wait

list(each(wait, [sys.argv[1]] * 2, 2))
"""


def wait(folder, progress):
    (Path(folder) / str(os.getpid())).touch()
    time.sleep(600.0)


@pytest.mark.system
def test_no_process_of_the_pool_outlives_the_one_that_shared_the_work_out(tmp_path):
    parent = subprocess.Popen([sys.executable, "-c", KILLED, str(tmp_path)])
    processes = eventually(lambda: len(found := [int(p.name) for p in tmp_path.iterdir()]) == 2 and found, 60.0, "work")
    parent.kill()
    parent.wait()
    eventually(lambda: not any(runs(process) for process in processes), 20.0, "they have ended")


def runs(process):
    """Whether it does; one that nobody has waited for has ended."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False
