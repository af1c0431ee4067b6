"""What is written can be read as it was written; what was changed, or taken out, is found."""

import json
import os
import threading
from concurrent.futures import ThreadPoolExecutor
from datetime import UTC, datetime

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from services.evidence.events import Repaired, StopChanged
from services.evidence.exceptions import NoLog
from services.evidence.ledger import LedgerFile, ledger_file
from services.evidence.reading import Reader, verify
from services.process.chained import ORIGIN
from tests.services.robot.site import AtOnce, Later

AT = datetime(2026, 3, 1, 8, 0, tzinfo=UTC)


def stop(reason):
    return StopChanged(latched=True, by="ann", reason=reason, released_by="")


@pytest.fixture
def path(tmp_path):
    return tmp_path / "robot1" / "evidence.jsonl"


def write(path, *reasons):
    ledger = LedgerFile(path, AtOnce(), lambda: AT)
    for reason in reasons:
        ledger.add(stop(reason))
    ledger.close()


def reasons(path):
    events = [found.entry.event for found in Reader(path)]
    return [event.reason if isinstance(event, StopChanged) else event for event in events]


def test_entries_come_back_in_their_order_with_number_and_time(path):
    write(path, "a", "b")
    entries = [found.entry for found in Reader(path)]
    assert [(entry.number, entry.at, entry.event.reason) for entry in entries] == [
        (1, "2026-03-01T08:00:00.000+00:00", "a"),
        (2, "2026-03-01T08:00:00.000+00:00", "b"),
    ]


def test_another_start_goes_on_where_the_last_one_ended(path):
    write(path, "a")
    write(path, "b")
    account = verify(path)
    assert (account.entries, account.faults, account.whole) == (2, (), True)


def test_a_line_is_json_that_any_tool_reads(path):
    write(path, "smoke")
    line = json.loads(path.read_text())
    assert (line["entry"]["event"]["what"], line["entry"]["event"]["reason"]) == ("stop", "smoke")


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_any_byte_that_is_changed_is_found(tmp_path_factory, data):
    path = tmp_path_factory.mktemp("log") / "evidence.jsonl"
    write(path, "a", "b", "c")
    head, content = verify(path).head, bytearray(path.read_bytes())
    at = data.draw(st.integers(0, len(content) - 1))
    content[at] ^= data.draw(st.integers(1, 255))
    path.write_bytes(content)
    assert not verify(path, head).whole


@pytest.mark.parametrize("gone", [0, 1])
def test_a_line_that_was_taken_out_is_found(path, gone):
    write(path, "a", "b", "c")
    lines = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(b"".join(lines[:gone] + lines[gone + 1 :]))
    assert [line for line, _ in verify(path).faults] == [gone + 1]


def test_lines_that_changed_their_places_are_found(path):
    write(path, "a", "b", "c")
    first, second, third = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(first + third + second)
    assert not verify(path).whole


def test_an_end_that_was_cut_off_is_found_by_a_digest_that_was_noted(path):
    write(path, "a", "b")
    noted = verify(path).head
    path.write_bytes(path.read_bytes().splitlines(keepends=True)[0])
    assert verify(path).whole
    assert not verify(path, noted).known


def test_a_digest_that_was_noted_long_ago_is_still_in_it(path):
    write(path, "a")
    noted = verify(path).head
    write(path, "b", "c")
    assert verify(path, noted).whole


@pytest.mark.parametrize("kept", range(1, 200, 23))
def test_a_power_cut_within_a_line_loses_that_line_and_is_told(path, kept):
    write(path, "a", "b")
    first, second = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(first + second[:kept])
    assert verify(path).unfinished == kept
    write(path, "c")
    assert reasons(path) == ["a", Repaired(size=kept + 1), "c"]
    assert verify(path).whole


def test_zeros_that_a_power_cut_left_are_told_as_well(path):
    write(path, "a")
    with path.open("ab") as file:
        file.write(bytes(300))
    write(path, "b")
    write(path, "c")
    assert reasons(path) == ["a", Repaired(size=301), "b", "c"]
    assert verify(path).whole


def test_what_was_garbled_after_it_was_written_is_no_power_cut(path):
    write(path, "a", "b", "c")
    first, _, third = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(first + b"garbled\n" + third)
    write(path, "d")
    assert not verify(path).whole


def test_what_cannot_be_written_stays_and_is_said_once(path, caplog):
    path.parent.mkdir()
    path.mkdir()
    ledger = LedgerFile(path, AtOnce(), lambda: AT)
    ledger.add(stop("a"))
    ledger.add(stop("b"))
    assert ledger.unwritten == 2
    assert [record.message for record in caplog.records] == [f"the evidence log is not written: {path}: Is a directory"]
    path.rmdir()
    ledger.add(stop("c"))
    assert reasons(path) == ["a", "b", "c"]
    assert ledger.unwritten == 0


def test_a_disk_that_is_full_leaves_no_half_an_entry(path, monkeypatch):
    write(path, "a")
    ledger = LedgerFile(path, AtOnce(), lambda: AT)
    real = os.write
    monkeypatch.setattr(os, "write", lambda file, content: real(file, content[:10]))
    ledger.add(stop("b"))
    assert ledger.unwritten == 1
    monkeypatch.setattr(os, "write", real)
    ledger.add(stop("c"))
    assert reasons(path) == ["a", Repaired(size=11), "b", "c"]
    assert verify(path).whole


def test_two_processes_cannot_write_the_same_log(path, caplog):
    first, second = (LedgerFile(path, AtOnce(), lambda: AT) for _ in range(2))
    first.add(stop("a"))
    second.add(stop("b"))
    assert "another process writes it" in caplog.text
    first.close()
    second.add(stop("c"))
    assert reasons(path) == ["a", "b", "c"]


def test_nobody_waits_for_the_disk(path):
    later = Later()
    ledger = LedgerFile(path, later, lambda: AT)
    ledger.add(stop("a"))
    assert not path.exists()
    later.catch_up()
    assert reasons(path) == ["a"]


def test_what_comes_while_it_writes_is_written(path):
    with ThreadPoolExecutor(1) as executor:
        ledger = LedgerFile(path, executor, lambda: AT)
        threads = [threading.Thread(target=lambda i=i: ledger.add(stop(str(i)))) for i in range(20)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        ledger.close()
    assert sorted(reasons(path), key=int) == [str(i) for i in range(20)]
    assert verify(path).whole


def test_a_log_that_is_not_there_is_one_line(path):
    with pytest.raises(NoLog) as caught:
        verify(path)
    assert str(caught.value).startswith(f"there is no evidence log to read: {path}: No such file")


def test_an_empty_log_is_whole(path):
    path.parent.mkdir()
    path.touch()
    assert (verify(path).whole, verify(path).head) == (True, ORIGIN)


def test_a_robot_s_log_is_in_the_user_s_state_folder(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    ledger = ledger_file("kitchen")
    ledger.add(stop("a"))
    ledger.close()
    assert reasons(tmp_path / "retouch" / "kitchen" / "evidence.jsonl") == ["a"]
