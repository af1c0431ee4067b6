"""What a journal has taken is there, whole and in its order, whatever happens; and nothing else changes it."""

import datetime
import os

import pytest
from hypothesis import given
from hypothesis import strategies as st

from services.study.events import Attempted, Consented, Noted, Repaired
from services.study.exceptions import JournalBroken, StudyInUse
from services.study.journal import FILE, Journal, read

AT = datetime.datetime(2026, 1, 1, tzinfo=datetime.UTC)


def journal(folder):
    return Journal(folder, lambda: AT)


def filled(folder, *texts):
    with journal(folder) as one:
        for number, text in enumerate(texts, 1):
            one.add(Noted(participant=number, text=text))


def texts(folder):
    return [entry.event.text for entry in read(folder)]


def test_what_was_added_is_read_again_in_its_order(tmp_path):
    filled(tmp_path, "one", "two")
    filled(tmp_path, "three")
    assert texts(tmp_path) == ["one", "two", "three"]
    assert [entry.number for entry in read(tmp_path)] == [1, 2, 3]


def test_two_cannot_write_at_once(tmp_path):
    with journal(tmp_path), pytest.raises(StudyInUse, match="is open elsewhere"):
        journal(tmp_path)
    journal(tmp_path).close()


@pytest.mark.parametrize("left", [1, 20, 60])
def test_what_a_power_cut_left_of_a_line_is_cut_off_and_told(tmp_path, left):
    filled(tmp_path, "one", "two")
    path = tmp_path / FILE
    line = path.read_bytes().splitlines(keepends=True)[-1]
    os.truncate(path, path.stat().st_size - len(line) + left)
    assert texts(tmp_path) == ["one"]
    with journal(tmp_path) as one:
        one.add(Noted(participant=2, text="again"))
        assert [entry.event for entry in one.entries[1:]] == [Repaired(size=left), Noted(participant=2, text="again")]
    assert len(read(tmp_path)) == 3


@given(st.data())
def test_a_changed_byte_is_found_and_nothing_is_written(tmp_path_factory, data):
    folder = tmp_path_factory.mktemp("study")
    filled(folder, "one", "two", "three")
    path = folder / FILE
    content = bytearray(path.read_bytes())
    # Of what is torn from the last line nobody can tell whether it was there.
    end = content.rindex(b"\n", 0, len(content) - 1)
    at = data.draw(st.integers(0, end))
    content[at] ^= data.draw(st.integers(1, 255))
    path.write_bytes(content)
    with pytest.raises(JournalBroken, match="nothing was changed in it"):
        journal(folder)
    assert path.read_bytes() == content


def test_a_line_that_was_taken_out_is_found(tmp_path):
    filled(tmp_path, "one", "two", "three")
    path = tmp_path / FILE
    lines = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(lines[0] + lines[2])
    with pytest.raises(JournalBroken, match="line 2"):
        read(tmp_path)


def test_a_participant_s_lines_become_tombstones_and_all_others_stay(tmp_path):
    filled(tmp_path, "one", "two")
    with journal(tmp_path) as one:
        one.add(Noted(participant=1, text="more"))
        assert one.erase(1, lambda _: True) == 2
        one.add(Noted(participant=2, text="later"))
    kinds = [(type(entry.event).__name__, entry.event.participant) for entry in read(tmp_path)]
    assert kinds == [("Erased", 1), ("Noted", 2), ("Erased", 1), ("Noted", 2)]
    assert b"more" not in (tmp_path / FILE).read_bytes()


def test_while_a_tombstone_is_set_nobody_else_can_open_it(tmp_path):
    filled(tmp_path, "one")
    with journal(tmp_path) as one:
        one.erase(1, lambda _: True)
        with pytest.raises(StudyInUse):
            journal(tmp_path)


def test_events_keep_their_fields(tmp_path):
    consent = Consented(participant=7, version="1", language="nl", text="abc")
    attempt = Attempted(
        participant=7, part="A/1", number=1, teaching=None, updates=0, success=False, reached=False, kicked_over=True,
        collision=False, active=0.0, began=1.0, ended=11.0, raw={"reset": 0.5},
    )  # fmt: skip
    with journal(tmp_path) as one:
        one.add(consent)
        one.add(attempt)
    assert [entry.event for entry in read(tmp_path)] == [consent, attempt]
