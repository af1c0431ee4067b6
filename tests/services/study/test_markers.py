"""A marker for every entry, once it is on the disk; without the package of the Lab Streaming Layer there is none."""

import datetime
import sys

import pytest

from services.study.events import Attempted, Enrolled, Noted
from services.study.journal import Journal, read
from services.study.session.markers import lab_streaming

WITHIN_S = 10.0
AT = datetime.datetime(2026, 1, 1, tzinfo=datetime.UTC)
EVENTS = (
    Enrolled(participant=3, order=("A",), group=0, language="en"),
    Attempted(
        participant=3, part="A/1", number=2, teaching=None, updates=0, success=True, reached=True, kicked_over=False,
        collision=False, active=0.0, began=0.0, ended=1.0,
    ),
    Noted(participant=None, text="the lamp went out"),
)  # fmt: skip


@pytest.fixture
def heard():
    """A function that gives the next marker, as another recorder hears it."""
    lsl = pytest.importorskip("pylsl")

    def listening():
        (stream,) = lsl.resolve_byprop("source_id", "retouch-thesis", timeout=WITHIN_S)
        inlet = lsl.StreamInlet(stream)
        inlet.open_stream(WITHIN_S)
        return lambda: inlet.pull_sample(WITHIN_S)[0]

    return listening


def test_every_entry_is_marked_once_it_can_be_read_again(tmp_path, heard):
    mark, seen = lab_streaming("thesis"), []
    following = heard()
    with Journal(tmp_path, lambda: AT, lambda entry: (mark(entry), seen.append(len(read(tmp_path))))) as journal:
        for event in EVENTS:
            journal.add(event)
    assert [following() for _ in EVENTS] == [["enrolled P03"], ["attempted P03 A/1 2"], ["noted"]]
    assert seen == [1, 2, 3]


def test_without_the_package_there_are_no_markers(monkeypatch):
    monkeypatch.setitem(sys.modules, "pylsl", None)
    assert lab_streaming("thesis") is None
