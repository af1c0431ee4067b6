"""Asking for the authority that another one holds: it is given, kept, or given by silence, and never by itself."""

import pytest

from protocol import queries, topics
from protocol.messages import AuthorityEvent, AuthorityRequest, Cut, Phase
from protocol.queries import Accepted, AuthorityGranted, Refused
from tests.services.robot.site import Site

SILENCE_S = 10.0
UNSAID_S = 1.0
NUMBER = 77


@pytest.fixture
def site():
    """Ann commands."""
    site = Site()
    site.acquire()
    return site


def asks(site, seconds, *, number=NUMBER, who="bob"):
    """Somebody says for so long that they ask, while the holder is present."""
    for _ in range(round(seconds * 10)):
        request = AuthorityRequest(operator=who.capitalize(), holder=who, number=number)
        site.operator.publish(topics.AUTHORITY_REQUEST, request)
        site.run(0.1)


def answer(site, *, give, number=NUMBER, holder="ann", epoch=None):
    epoch = site.epoch if epoch is None else epoch
    return site.ask(queries.ANSWER, queries.AnswerRequest(holder, epoch, number, give))


def authority(site):
    return site.authority_states.latest().message


def test_everybody_is_told_who_asks_and_how_long_silence_takes(site):
    asks(site, 0.5)
    state = authority(site)
    assert (state.holder, state.asked_by, state.asked) == ("ann", "Bob", NUMBER)
    assert state.asked_left == pytest.approx(SILENCE_S - 0.4, abs=0.11)


def test_who_holds_the_authority_gives_it_to_who_asks(site):
    asks(site, 0.5)
    epoch = site.epoch
    assert answer(site, give=True) == Accepted()
    site.run(0.01)
    state = authority(site)
    assert (state.holder, state.operator, state.event) == ("bob", "Bob", AuthorityEvent.GIVEN)
    assert (state.before, state.asked, state.reason) == ("ann", 0, "")
    assert state.epoch > epoch


def test_who_keeps_the_authority_is_asked_no_more_by_the_same_request(site):
    asks(site, 0.5)
    assert answer(site, give=False) == Accepted()
    asks(site, SILENCE_S + 1.0)
    state = authority(site)
    assert (state.holder, state.asked, state.kept_from) == ("ann", 0, NUMBER)
    asks(site, 0.3, number=NUMBER + 1)
    assert authority(site).asked == NUMBER + 1


def test_silence_gives_the_authority(site):
    asks(site, SILENCE_S - 0.2)
    assert authority(site).holder == "ann"
    asks(site, 0.4)
    state = authority(site)
    assert (state.holder, state.event, state.before) == ("bob", AuthorityEvent.GIVEN_BY_SILENCE, "ann")


def test_whoever_asked_and_is_heard_no_more_gets_nothing(site):
    asks(site, 2.0)
    site.run(SILENCE_S)
    state = authority(site)
    assert (state.holder, state.asked, state.asked_left) == ("ann", 0, 0.0)


def test_one_question_at_a_time(site):
    asks(site, 0.3)
    asks(site, 0.3, number=NUMBER + 1, who="eve")
    assert authority(site).asked == NUMBER
    site.run(UNSAID_S)
    asks(site, 0.3, number=NUMBER + 1, who="eve")
    assert authority(site).asked_by == "Eve"


def test_whoever_holds_the_authority_has_nobody_to_ask(site):
    asks(site, 0.3, who="ann")
    assert authority(site).asked == 0


def test_where_nobody_holds_it_the_authority_is_not_asked_for(site):
    site.ask(queries.RELEASE, queries.ReleaseAuthority("ann", site.epoch))
    asks(site, 0.5)
    assert authority(site).asked == 0


@pytest.mark.parametrize(
    "wrong", [{"holder": "bob"}, {"epoch": 1}, {"number": NUMBER + 1}], ids=["holder", "epoch", "number"]
)
def test_only_the_holder_answers_and_only_what_is_asked(site, wrong):
    asks(site, 0.3)
    assert isinstance(answer(site, give=True, **wrong), Refused)
    assert authority(site).holder == "ann"


def test_a_motion_does_not_go_on_under_who_was_given_the_authority(site):
    site.execute()
    site.run(0.3)
    asks(site, 0.3)
    answer(site, give=True)
    site.run(4.0)
    assert site.state.phase is Phase.IDLE
    assert (site.result.cut, site.result.reason) == (Cut.TAKEN_OVER, "Bob has the authority now")


def test_who_was_given_the_authority_begins_a_lease_of_its_own(site):
    asks(site, 0.3)
    answer(site, give=True)
    granted = site.ask(queries.ACQUIRE, queries.AcquireAuthority("bob", "Bob"))
    assert isinstance(granted, AuthorityGranted)
    site.epoch, site.holder = granted.epoch, "bob"
    site.run(3.0)
    assert authority(site).holder == "bob"


def test_a_revocation_lets_the_motion_hold_where_it_is_and_it_goes_on_only_when_asked(site):
    site.execute()
    site.run(0.8)
    assert site.ask(queries.REVOKE, queries.RevokeAuthority("eve", "it is late")) == Accepted()
    assert site.state.phase is Phase.HOLD
    before = site.state.reference
    site.run(3.0)
    assert site.state.reference == before
    state = authority(site)
    assert (state.holder, state.event, state.by, state.reason) == ("", AuthorityEvent.REVOKED, "eve", "it is late")
    site.acquire("ann")
    site.run(0.5)
    assert (site.state.phase, site.state.waiting) == (Phase.HOLD, True)


def test_a_take_over_is_logged_with_who_and_why_in_one_line(site, caplog):
    taken = queries.AcquireAuthority("station-b", "Bob", take_over=True, reason="she left\nthe room")
    assert isinstance(site.ask(queries.ACQUIRE, taken), AuthorityGranted)
    (line,) = [record.getMessage() for record in caplog.records]
    assert line == "ann's authority was taken over by Bob: she left the room"
    assert authority(site).reason == "she left\nthe room"
