"""The stop and the epochs outlive the process; where they cannot, the safe answer is taken and a line says so."""

import errno
import json
import logging
import threading
from pathlib import Path

import pytest

from services.robot import memory as memory_module
from services.robot.latch import LONGEST_REASON, Latch
from services.robot.memory import RESERVED, RETRY, SafetyFile, Volatile, safety_file
from tests.services.robot.site import AtOnce, Later

NOW = "2026-03-01T08:00:00+00:00"
PRESSED = Latch(latched=True, by="bob", reason="smoke", at=NOW)


@pytest.fixture
def path(tmp_path):
    return tmp_path / "state" / "robot1" / "safety.json"


def remembered(path):
    return SafetyFile(path, AtOnce())


def test_a_robot_without_a_file_is_not_stopped(path):
    record = remembered(path).recall(NOW)
    assert (record.latched, record.epoch_bound) == (False, 0)


def test_a_latched_stop_is_recalled_as_it_was(path):
    remembered(path).keep(PRESSED, 7)
    assert remembered(path).recall("later").latch == PRESSED


def test_a_release_is_recalled_with_who_and_when(path):
    remembered(path).keep(PRESSED.released("ann", "then"), 7)
    latch = remembered(path).recall("later").latch
    assert (latch.latched, latch.released_by, latch.at) == (False, "ann", "then")


def test_the_bound_is_above_every_epoch_that_was_given_out(path):
    memory = remembered(path)
    for epoch in range(3 * RESERVED):
        memory.keep(Latch(), epoch)
        assert json.loads(path.read_bytes())["epoch_bound"] > epoch


def test_a_change_of_the_epoch_waits_for_no_disk(path, monkeypatch):
    written = []
    monkeypatch.setattr(memory_module, "write_whole", lambda path, content: written.append(content))
    memory = remembered(path)
    for epoch in range(RESERVED):
        memory.keep(Latch(), epoch)
    assert len(written) == 2


def test_epochs_are_reserved_anew_when_less_than_half_of_them_are_left(path):
    memory = remembered(path)
    for epoch, bound in (
        (0, RESERVED),
        (RESERVED // 2, RESERVED),
        (RESERVED // 2 + 1, RESERVED // 2 + 1 + RESERVED),
    ):
        memory.keep(Latch(), epoch)
        assert json.loads(path.read_bytes())["epoch_bound"] == bound


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"{",
        b"{}",
        b"[]",
        b'{"latched": "no"}',
        b'{"latched": false, "who": 1}',
        b"\xff\xfe",
        b'{"by": "\xe3"}',
        b"[" * 100_000,
        b'{"epoch_bound": -1}',
    ],
)
def test_a_file_that_cannot_be_understood_is_a_latched_stop_that_says_so(path, content, caplog):
    path.parent.mkdir(parents=True)
    path.write_bytes(content)
    record = remembered(path).recall(NOW)
    assert (record.latched, record.by, record.at) == (True, "robot", NOW)
    assert str(path)[:50] in record.reason
    assert "\n" not in record.reason
    assert [entry.levelno for entry in caplog.records] == [logging.ERROR]


def test_a_file_that_says_more_than_is_known_is_a_latched_stop(path):
    remembered(path).keep(Latch(), 7)
    path.write_text(json.dumps(json.loads(path.read_bytes()) | {"paused": True}))
    assert remembered(path).recall(NOW).latched


@pytest.mark.parametrize(
    ("error", "cause"), [(OSError(errno.EIO, "Input/output error"), "Input/output error"), (OSError("odd"), "odd")]
)
def test_a_file_that_cannot_be_read_is_a_latched_stop_that_says_what_to_do(path, monkeypatch, error, cause):
    def read(_):
        raise error

    monkeypatch.setattr(Path, "read_bytes", read)
    record = remembered(path).recall(NOW)
    assert record.latched
    assert record.reason == f"{path} cannot be read ({cause}): look at the robot, then release the stop"


def test_a_reason_is_kept_as_far_as_it_can_be_told_again():
    assert len(Latch().pressed("bob", "x" * 4096, NOW).reason) == LONGEST_REASON


def test_what_is_being_written_is_not_settled(path):
    disk = Later()
    memory = SafetyFile(path, disk)
    assert memory.settled
    memory.keep(PRESSED, 1)
    assert not memory.settled
    assert not path.exists()
    disk.catch_up()
    assert memory.settled
    assert memory.fault == ""
    assert json.loads(path.read_bytes())["latched"] is True


@pytest.mark.parametrize(
    ("error", "cause"), [(OSError(errno.EIO, "Input/output error"), "Input/output error"), (OSError("odd"), "odd")]
)
def test_what_cannot_be_written_is_a_fault_that_says_where_and_why(path, error, cause):
    disk = Later()
    memory = SafetyFile(path, disk)
    assert memory.fault == ""
    memory.keep(PRESSED, 1)
    disk.fail(error)
    assert memory.fault == f"the stop would not outlive this process: {path} cannot be written ({cause})"


def test_what_was_written_is_not_written_again(path):
    disk = Later()
    memory = SafetyFile(path, disk)
    memory.keep(PRESSED, 1)
    disk.catch_up()
    for _ in range(3 * RETRY):
        assert memory.settled
        memory.keep(PRESSED, 1)
    assert disk.waiting == []


def test_what_could_not_be_written_is_tried_again_now_and_then(path):
    disk = Later()
    memory = SafetyFile(path, disk)
    tried = []
    for call in range(1, 3 * RETRY + 1):
        memory.keep(PRESSED, 1)
        if disk.waiting:
            tried.append(call)
            disk.fail(OSError(errno.ENOSPC, "No space left on device"))
        assert memory.fault
    assert tried == [1, RETRY, 2 * RETRY, 3 * RETRY]


def test_while_a_disk_does_not_answer_no_second_attempt_piles_up(path):
    disk = Later()
    memory = SafetyFile(path, disk)
    memory.keep(PRESSED, 1)
    disk.fail(OSError(errno.EIO, "Input/output error"))
    for _ in range(3 * RETRY):
        assert memory.fault
        memory.keep(PRESSED, 1)
    assert len(disk.waiting) == 1


def test_a_full_disk_is_said_once_and_tried_again(path, monkeypatch, caplog):
    full = True

    def write(path, content):
        if full:
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(memory_module, "write_whole", write)
    memory = remembered(path)
    for _ in range(5 * RETRY):
        memory.keep(PRESSED, 1)
        assert memory.settled
        assert "No space left on device" in memory.fault
    assert len(caplog.records) == 1
    full = False
    for _ in range(RETRY):
        memory.keep(PRESSED, 1)
        assert memory.settled
    assert memory.fault == ""
    assert len(caplog.records) == 1


def test_the_file_lies_in_the_robots_own_state_folder(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    memory = safety_file("kitchen")
    memory.keep(PRESSED, 1)
    memory.close()
    assert (tmp_path / "retouch" / "kitchen" / "safety.json").is_file()


def test_one_record_is_written_after_another(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    disk_answers = threading.Event()
    written = []

    def write(path, content):
        assert disk_answers.wait(10.0)
        written.append(json.loads(content)["by"])

    monkeypatch.setattr(memory_module, "write_whole", write)
    memory = safety_file("kitchen")
    names = [f"operator {number}" for number in range(5)]
    for name in names:
        memory.keep(Latch().pressed(name, "", NOW), 1)
    writers = [thread for thread in threading.enumerate() if thread.name.startswith("safety-file")]
    disk_answers.set()
    memory.close()
    assert len(writers) == 1
    assert written == names


def test_a_robot_that_remembers_nothing_has_no_stop_and_no_fault():
    memory = Volatile()
    memory.keep(PRESSED, 7)
    assert (memory.settled, memory.fault) == (True, "")
    record = memory.recall(NOW)
    assert (record.latch, record.epoch_bound) == (Latch(), 0)
