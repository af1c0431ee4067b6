"""Ctrl-C and SIGTERM end everything, soon and cleanly, and what happened so far is told."""

import contextlib
import json
import os
import signal
import subprocess
import time

import psutil
import pytest

from services.process.exit_codes import Exit
from services.process.processes import PROCESS_NAMES
from services.viewer.web_files import sdk_program
from tests.system.harness import START_S, Command, Witness, configured, eventually, free_endpoint, reachable

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.alone]

STOP_S = 2.0
"""Within which a process obeys."""


@pytest.mark.sim
def test_an_interrupted_system_ends_within_seconds_and_nothing_had_to_be_killed(tmp_path):
    endpoint = free_endpoint()
    arguments = ("--fresh", "--no-browser", "--json", "out.json", "--config", configured(tmp_path, endpoint))
    with Command("up", *arguments, folder=tmp_path) as up:
        with Witness(endpoint) as witness:
            witness.next_beats(PROCESS_NAMES, START_S)
        interrupted = time.monotonic()
        up.process.send_signal(signal.SIGINT)
        assert up.ended(10.0) == 0
        assert time.monotonic() - interrupted < 2 * STOP_S, "the processes, then the router"
        assert up.left() == []
    assert "did not stop in time" not in up.out
    assert up.err == ""
    report = json.loads((tmp_path / "out.json").read_text())
    assert (report["loop_closed"], report["reason"]) == (False, "interrupted")


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_process_that_stands_alone_ends_with_0(tmp_path, number):
    endpoint = free_endpoint()
    with Command("router", "--listen", endpoint, folder=tmp_path) as router:
        router.until(lambda: reachable(endpoint), START_S, "the router listens")
        with Command("master", "--connect", endpoint, folder=tmp_path) as master, Witness(endpoint) as witness:
            witness.next_beats({"master"}, START_S)
            for command in (master, router):
                command.process.send_signal(number)
                assert command.ended(STOP_S) == 0
                assert "Traceback" not in command.err


def _pool(command):
    """The processes that share a command's work."""
    lines = []
    for process in command.left():
        with contextlib.suppress(psutil.Error):  # it has ended meanwhile
            lines.append(process.cmdline())
    return [line for line in lines if any("popen_loky" in argument for argument in line)]


@pytest.mark.sim
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("reproduce", "--jobs", "2"), "interrupted with "),
        (("map", "--jobs", "2", "--grid", "30"), "interrupted: no map is drawn"),
    ],
    ids=["reproduce", "map"],
)
def test_work_that_is_shared_out_is_left_at_once_with_one_line_and_without_its_processes(
    tmp_path, arguments, said, number
):
    with Command(*arguments, folder=tmp_path) as command:
        command.until(lambda: _pool(command), START_S, "a process has been started, and imports yet")
        before = command.err
        if number == signal.SIGINT:
            os.killpg(command.process.pid, number)  # as a terminal does
        else:
            command.process.send_signal(number)
        assert command.ended(STOP_S) == Exit.INTERRUPTED, command.tail()
        eventually(lambda: not _pool(command), STOP_S, lambda: str(_pool(command)))
        # What looks after shared memory ends once it has started and sees that nobody is there: on a busy machine
        # that takes as long as any process takes to start.
        eventually(lambda: command.left() == [], START_S, command.left)
    lines = [line for line in command.err.removeprefix(before).splitlines() if line]
    assert len(lines) == 1, "\n".join(lines)
    assert lines[0].startswith(said)


def test_an_interrupted_run_that_should_have_closed_the_loop_says_so(tmp_path):
    arguments = ("--headless", "--once", "--only", "master", "--config", configured(tmp_path, free_endpoint()))
    with Command("up", *arguments, folder=tmp_path) as up:
        up.until(lambda: "master | INFO started" in up.out, START_S, "the master has started")
        up.process.terminate()
        assert up.ended(10.0) == Exit.INTERRUPTED


@pytest.mark.sim
def test_a_terminal_that_is_closed_ends_it_as_sigterm_does_and_the_recording_is_whole(tmp_path):
    endpoint = free_endpoint()
    arguments = ("--fresh", "--no-browser", "--json", "out.json", "--config", configured(tmp_path, endpoint))
    with Command("up", *arguments, folder=tmp_path) as up:
        with Witness(endpoint) as witness:
            witness.next_beats(PROCESS_NAMES, START_S)
        os.killpg(up.process.pid, signal.SIGHUP)
        assert up.ended(10.0) == Exit.DONE
        assert up.left() == []
    report = json.loads((tmp_path / "out.json").read_text())
    assert report["reason"] == "interrupted"
    assert not any(report["restarts"].values())
    verified = subprocess.run(
        [sdk_program(), "rrd", "verify", report["recording"]], capture_output=True, text=True, timeout=60.0, check=False
    )
    assert verified.returncode == 0, verified.stderr


@pytest.mark.parametrize("number", [signal.SIGHUP, signal.SIGINT])
def test_what_a_terminal_sends_to_its_group_reaches_the_supervisor_alone(tmp_path, number):
    arguments = ("--only", "master", "--no-browser", "--config", configured(tmp_path, free_endpoint()))
    with Command("up", *arguments, folder=tmp_path) as up:
        up.until(lambda: "master | INFO started" in up.out, START_S, "the master has started")
        assert all(os.getpgid(pid) == pid for pid in up.pids().values())
        os.killpg(up.process.pid, number)
        assert up.ended(10.0) == Exit.DONE
    assert "starts again" not in up.out


@pytest.mark.parametrize("shell", ["<&- >&- 2>&-", "> >(head -n 1 > first) 2>&1"], ids=["closed", "head"])
def test_streams_that_nobody_reads_end_nothing(tmp_path, shell):
    endpoint = free_endpoint()
    arguments = ("--only", "master", "--no-browser", "--json", "out.json", "--config", configured(tmp_path, endpoint))
    with Command("up", *arguments, folder=tmp_path, shell=shell) as up, Witness(endpoint) as witness:
        first = witness.next_beats({"master"}, START_S)["master"]
        os.kill(first.pid, signal.SIGKILL)  # what is said of it has nowhere to go
        up.until(lambda: (beat := witness.beats().get("master")) and beat.pid != first.pid, START_S, "it is back")
        up.process.terminate()
        assert up.ended(10.0) == Exit.DONE
    assert json.loads((tmp_path / "out.json").read_text())["restarts"]["master"] == 1


def test_a_log_that_nobody_takes_holds_no_process_up_and_it_ends_all_the_same(tmp_path, router):
    out, into = os.pipe()
    os.set_blocking(into, False)
    with contextlib.suppress(BlockingIOError):
        while True:
            os.write(into, b"\n")
    os.set_blocking(into, True)
    stopped = f"2> /proc/{os.getpid()}/fd/{into}"
    with Command("master", "--connect", router, folder=tmp_path, shell=stopped) as master, Witness(router) as witness:
        witness.next_beats({"master"}, START_S)
        master.process.terminate()
        assert master.ended(10.0) == Exit.DONE
    os.close(into)
    os.close(out)
