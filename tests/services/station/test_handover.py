"""The authority between stations: asked for while it is asked, answered by who has it, revoked with who and why."""

import pytest

from protocol import queries, topics
from protocol.messages import AuthorityState
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.station.handover import HandOver


class Site:
    """A station's hand-over, and a robot."""

    def __init__(self):
        self.clock = ManualClock()
        network = MemoryNetwork(self.clock)
        robot = network.bus()
        self.requests = robot.subscribe(topics.AUTHORITY_REQUEST)
        self.answers = robot.serve(queries.ANSWER)
        self.revocations = robot.serve(queries.REVOKE)
        self.hand_over = HandOver(network.bus(), "station-1")


def asked(holder="station-1", number=77):
    return AuthorityState(operator="ann", holder=holder, epoch=5, expires_in=1.0, asked=number, asked_by="bob")


def test_a_request_is_said_on_at_the_topic_s_rate():
    site, said = Site(), []
    for _ in range(50):
        site.clock.advance(0.02)
        site.hand_over.ask(7, "ann", site.clock.now_ns())
        said += site.requests.take()
    assert len(said) == topics.AUTHORITY_REQUEST.rate_hz
    assert {(r.message.operator, r.message.holder, r.message.number) for r in said} == {("ann", "station-1", 7)}


@pytest.mark.parametrize("give", [True, False])
def test_what_is_asked_is_answered_under_the_epoch(give):
    site = Site()
    site.hand_over.answer(asked(), give=give)
    (call,) = site.answers.take()
    said = call.request
    assert (said.holder, said.epoch, said.number, said.give) == ("station-1", 5, 77, give)
    assert said.request


@pytest.mark.parametrize("authority", [None, asked(number=0), asked(holder="station-2")])
def test_where_nobody_asks_this_station_nothing_is_answered(authority):
    site = Site()
    site.hand_over.answer(authority, give=True)
    assert site.answers.take() == []


def test_a_revocation_says_who_and_why_and_what_became_of_it():
    site = Site()
    assert site.hand_over.fault(1) == ""
    site.hand_over.revoke("eve", "it is late", 0)
    (call,) = site.revocations.take()
    assert (call.request.by, call.request.reason) == ("eve", "it is late")
    assert site.hand_over.fault(1) == ""
    call.reply(queries.Refused("nobody holds the authority"))
    assert site.hand_over.fault(1) == "Not revoked: nobody holds the authority."
    assert site.hand_over.fault(9_000_000_000) == ""
    site.hand_over.revoke("eve", "it is late", 0)
    (call,) = site.revocations.take()
    call.reply(queries.Accepted())
    assert site.hand_over.fault(1) == ""
