"""A marker for every entry, once it is on the disk; without the package of the Lab Streaming Layer there is none."""

import datetime
import sys
from types import ModuleType

import pytest

from services.study.events import Attempted, Enrolled, Noted
from services.study.journal import Journal, read
from services.study.session.markers import lab_streaming

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
def outlet(monkeypatch):
    """Stands in for pylsl, whose library is not everywhere: the samples that were pushed."""
    pushed = []

    class Outlet:
        def __init__(self, info):
            self.info = info

        def push_sample(self, sample):
            pushed.append(sample)

    lsl = ModuleType("pylsl")
    lsl.StreamInfo, lsl.StreamOutlet = lambda *facts: facts, Outlet
    monkeypatch.setitem(sys.modules, "pylsl", lsl)
    return pushed


def test_every_entry_is_marked_once_it_can_be_read_again(tmp_path, outlet):
    mark, seen = lab_streaming("thesis"), []
    with Journal(tmp_path, lambda: AT, lambda entry: (mark(entry), seen.append(len(read(tmp_path))))) as journal:
        for event in EVENTS:
            journal.add(event)
    assert outlet == [["enrolled P03"], ["attempted P03 A/1 2"], ["noted"]]
    assert seen == [1, 2, 3]


def test_without_the_package_nothing_is_marked(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pylsl", None)
    with Journal(tmp_path, lambda: AT, lab_streaming("thesis")) as journal:
        journal.add(EVENTS[0])
    assert len(read(tmp_path)) == 1
