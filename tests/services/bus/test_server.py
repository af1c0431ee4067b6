"""What is asked twice is done once, and gets the answer that was given."""

from dataclasses import FrozenInstanceError

import pytest

from protocol import queries
from protocol.queries import Accepted, Refused
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock


class Rig:
    """Somebody who finishes episodes, and whoever asks for it."""

    def __init__(self):
        self.clock = ManualClock()
        self.network = MemoryNetwork(self.clock)
        self.server = self.network.bus().serve(queries.FINISH)
        self.done = []

    def finish(self, number=0):
        return self.network.bus().ask(queries.FINISH, queries.Finish(1, request=number))

    def answer(self, reply=None):
        for call in self.server.take():
            self.done.append(call.request)
            call.reply(reply or Accepted())


@pytest.fixture
def rig():
    return Rig()


def test_a_request_that_was_answered_gets_the_same_answer_and_is_not_carried_out_again(rig):
    first = rig.finish(7)
    rig.answer()
    again = rig.finish(7)
    assert first.poll() == again.poll() == Accepted()
    rig.answer()
    assert len(rig.done) == 1


def test_a_refusal_is_an_answer_too(rig):
    rig.finish(7)
    rig.answer(Refused("no episode is running"))
    assert rig.finish(7).poll() == Refused("no episode is running")
    assert rig.server.take() == []


def test_a_request_that_is_still_being_answered_is_joined(rig):
    first = rig.finish(7)
    (call,) = rig.server.take()
    again = rig.finish(7)
    assert rig.server.take() == []
    assert again.poll() is None
    call.reply(Accepted())
    assert first.poll() == again.poll() == Accepted()


def test_a_request_that_waits_in_the_queue_is_joined_as_well(rig):
    pending = [rig.finish(7) for _ in range(3)]
    rig.answer()
    assert [one.poll() for one in pending] == [Accepted()] * 3
    assert len(rig.done) == 1


def test_of_many_that_wait_for_one_answer_the_newest_get_it(rig):
    pending = [rig.finish(7) for _ in range(16 + 5)]
    rig.answer()
    assert [one.poll() for one in pending] == [None] * 5 + [Accepted()] * 16


def test_requests_without_a_number_and_those_of_other_numbers_are_carried_out_each(rig):
    for number in (0, 0, 1, 2):
        rig.finish(number)
    rig.answer()
    rig.finish(0)
    rig.answer()
    assert len(rig.done) == 5


def test_what_changes_nothing_is_asked_anew_each_time():
    network = MemoryNetwork(ManualClock())
    server = network.bus().serve(queries.DESCRIBE)
    for _ in range(3):
        network.bus().ask(queries.DESCRIBE, queries.Describe())
    assert len(server.take()) == 3


def test_a_number_means_nothing_to_another_query(rig):
    rig.finish(7)
    rig.answer()
    other = rig.network.bus().serve(queries.UNDO)
    rig.network.bus().ask(queries.UNDO, queries.Undo(request=7))
    assert len(other.take()) == 1


def test_an_answer_is_kept_for_ten_minutes(rig):
    rig.finish(7)
    rig.answer()
    rig.clock.advance(600.0)
    rig.finish(7)
    assert rig.server.take() == []
    rig.clock.advance(1e-9)
    rig.finish(7)
    assert len(rig.server.take()) == 1


def test_the_newest_1024_answers_are_kept(rig):
    for number in range(1, 1024 + 2):
        rig.finish(number)
        rig.answer()
    rig.finish(1024 + 1)
    rig.finish(3)
    assert rig.server.take() == []
    rig.finish(1)
    assert len(rig.server.take()) == 1


def test_a_request_too_many_is_refused_at_once_and_can_be_asked_again(rig):
    for _ in range(64):
        assert rig.finish().poll() is None
    refused = rig.finish(7).poll()
    assert "too many requests wait for cmd/finish" in refused.reason
    assert rig.server.drops.crowded == 1
    assert "64 requests wait already" in rig.server.take_fault()
    rig.answer()
    pending = rig.finish(7)
    rig.answer()
    assert pending.poll() == Accepted()


def test_an_answer_that_nobody_remembers_the_question_of_goes_nowhere(rig):
    pending = rig.finish(7)
    (call,) = rig.server.take()
    rig.clock.advance(1200.0)
    rig.finish(8)
    call.reply(Accepted())
    assert pending.poll() is None


def test_requests_are_counted(rig):
    rig.finish(6)
    rig.clock.advance(1.0)
    first = rig.server.figures(rig.clock.now_ns())
    assert (first.topic, first.rate_hz, first.age, first.latency) == ("cmd/finish", 0.0, -1.0, -1.0), "no interval yet"
    for _ in range(3):
        rig.finish(7)
    rig.clock.advance(0.5)
    assert rig.server.figures(rig.clock.now_ns()).rate_hz == pytest.approx(6.0)
    rig.clock.advance(1.0)
    assert rig.server.figures(rig.clock.now_ns()).rate_hz == 0.0
    assert rig.server.figures(rig.clock.now_ns()).rate_hz == 0.0, "nor is there one now"


def test_nobody_can_change_what_was_asked(rig):
    rig.finish(7)
    (call,) = rig.server.take()
    with pytest.raises(FrozenInstanceError):
        call.request = queries.Finish(2)
