"""`retouch history`: what a running model has learnt, in a terminal; and what is asked of it to take an entry back."""

import io
import threading

import pytest

from protocol import queries
from protocol.messages import Method, ModelState, Part, Purpose
from protocol.queries import Entry, HistoryListed, ListHistory
from services.bus.memory import MemoryNetwork
from services.cli import parser
from services.commands.history import listed, show
from services.commands.model_process import ModelProcess
from services.commands.terminal import Terminal
from services.process.clock import ManualClock
from services.process.exceptions import CommandFailed

STATE = ModelState(kind="adaptive", version=3, demonstrations=1, updates=1, scene="dishwasher", robot_kind="tiago")


def entry(number, **changed):
    known = {
        "id": number,
        "purpose": Purpose.UPDATE,
        "method": Method.REFINE,
        "operator": "anna",
        "at": "2026-03-01T12:00:00+00:00",
        "alpha": 1.0,
        "part": Part(),
        "object_position": (0.86, 0.2, 0.553),
        "mean": 0.021,
        "most": 0.0874,
        "in_use": True,
    }
    return Entry(**{**known, **changed})


def printed(*entries):
    console = Terminal(file=io.StringIO(), width=160)
    show(STATE, HistoryListed(3, entries), console)
    return console.file.getvalue().splitlines()


def test_a_row_says_what_who_when_and_by_how_much():
    lines = printed(entry(2), entry(1, purpose=Purpose.INITIAL, method=Method.UNKNOWN, operator="", at="", most=-1.0))
    assert lines[0] == "dishwasher with robot tiago: version 3, 2 of 2 in use"
    assert lines[2].split()[:3] == ["2", "Correction", "while"]
    for said in ("anna", "2026-03-01", "up to 87 mm, 21 mm on average", "yes"):
        assert said in lines[2]
    assert lines[3].split() == ["1", "First", "demonstration", "-", "-", "-", "yes"]


def test_what_was_taken_back_says_by_whom_and_is_not_in_use():
    (_, _, line) = printed(entry(2, in_use=False, turned_by="ben", turned_at="2026-03-02T12:00:00+00:00"))
    assert "no: taken back by ben, 2026-03-02" in line


def test_part_and_belief_are_told_where_they_are_not_all():
    (_, _, line) = printed(entry(2, alpha=0.5, part=Part(0.1, 0.6), method=Method.WAYPOINTS))
    assert "Correction through waypoints, believed 50 %, 10 to 60 % of the motion" in line


@pytest.mark.parametrize("text", ["", "yesterday", "\x1b[31mred"])
def test_a_time_that_is_none_breaks_nothing(text):
    (_, _, line) = printed(entry(2, at=text))
    assert "\x1b" not in line


def test_without_entries_it_says_so():
    assert printed() == ["dishwasher with robot tiago: nothing learnt yet"]


class Ticking(ManualClock):
    """Whoever waits lets the model answer."""

    def __init__(self, answer):
        super().__init__()
        self._answer = answer

    def sleep_until(self, deadline_ns, stop):
        self.advance((deadline_ns - self.now_ns()) / 1e9)
        self._answer()


def asking(query, answer):
    """A model process that answers one query so."""
    waits = []
    clock = Ticking(lambda: [call.reply(answer(call.request)) for call in waits[0].take()])
    network = MemoryNetwork(clock)
    waits.append(network.bus("model").serve(query))
    return ModelProcess(network.bus("history"), network.robot, clock, threading.Event())


def test_a_long_history_is_asked_for_part_by_part():
    def answer(request: ListHistory):
        first = request.before or 6
        told = tuple(entry(number) for number in range(first - 1, max(0, first - 3), -1))
        return HistoryListed(6, told, max(0, first - 3))

    assert [one.id for one in listed(asking(queries.HISTORY, answer)).entries] == [5, 4, 3, 2, 1]


def test_what_the_model_refuses_is_one_line_with_its_reason():
    model = asking(queries.UNDO, lambda _: queries.Refused("the history holds no entry 9: choose one that it lists"))
    with pytest.raises(CommandFailed, match="the model does not take entry 9 back: the history holds no entry 9"):
        model.ask(queries.UNDO, queries.Undo(entry=9, request=1), "take entry 9 back")


@pytest.mark.parametrize("flags", [("--undo", "0"), ("--redo", "one"), ("--undo", "1", "--redo", "2")])
def test_an_entry_is_a_number_and_turned_one_way(flags, capsys):
    with pytest.raises(SystemExit) as caught:
        parser().parse_args(["history", *flags])
    assert caught.value.code == 2
    assert flags[0] in capsys.readouterr().err
