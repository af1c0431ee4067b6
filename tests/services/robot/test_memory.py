"""The stop and the epochs outlive the process; where they cannot, the safe answer is taken and a line says so."""

import errno
import json
import logging

import pytest

from services.robot import memory as memory_module
from services.robot.latch import LONGEST_REASON, Latch
from services.robot.memory import RESERVED, RETRY, SafetyFile, safety_file
from tests.services.robot.site import AtOnce, Later

NOW = "2026-03-01T08:00:00+00:00"
PRESSED = Latch(latched=True, by="bob", reason="smoke", at=NOW)


@pytest.fixture
def path(tmp_path):
    return tmp_path / "robot1" / "safety.json"


def remembered(path):
    return SafetyFile(path, AtOnce())


def test_a_robot_without_a_file_is_not_stopped(path):
    record = remembered(path).recall(NOW)
    assert (record.latched, record.epoch_bound) == (False, 0)


def test_a_latched_stop_is_recalled_as_it_was(path):
    remembered(path).keep(PRESSED, 7)
    record = remembered(path).recall("later")
    assert (record.latched, record.by, record.reason, record.at) == (True, "bob", "smoke", NOW)


def test_a_release_is_recalled_with_who_and_when(path):
    remembered(path).keep(PRESSED.released("ann", "then"), 7)
    record = remembered(path).recall("later")
    assert (record.latched, record.released_by, record.at) == (False, "ann", "then")


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
        b'{"epoch_bound": -1}',
    ],
)
def test_a_file_that_cannot_be_understood_is_a_latched_stop_that_says_so(path, content, caplog):
    path.parent.mkdir()
    path.write_bytes(content)
    record = remembered(path).recall(NOW)
    assert (record.latched, record.by, record.at) == (True, "robot", NOW)
    assert str(path)[:50] in record.reason
    assert "\n" not in record.reason
    assert [entry.levelno for entry in caplog.records] == [logging.ERROR]


def test_a_file_that_cannot_be_read_is_a_latched_stop_too(path):
    path.mkdir(parents=True)
    record = remembered(path).recall(NOW)
    assert record.latched
    assert "Is a directory" in record.reason


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


def test_the_file_lies_in_the_robots_own_state_folder(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    memory = safety_file("kitchen")
    memory.keep(PRESSED, 1)
    memory.close()
    assert (tmp_path / "retouch" / "kitchen" / "safety.json").is_file()
