"""Where another station commands this one watches: its operator asks or takes over, and nothing happens by itself."""

import msgspec
import pytest

from protocol import queries
from protocol.messages import AuthorityEvent
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from services.station.workflow.words import teaching_state
from tests.services.station.workflow.site import BY_HAND, HOLD, SCRIPTED, STOPPED, Site, authority


def text(site):
    return teaching_state(site.state, site.view, site.settings).told


def taken_over(site, by="bob"):
    site.epoch += 1
    site.sees(authority=authority("station-b", site.epoch, by))
    site.step()


def test_who_took_over_is_said_and_the_authority_is_not_asked_for_again():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    taken_over(site)
    assert site.state.phase is Phase.WATCHING
    assert "bob" in site.state.event
    assert site.stay(60) == []
    site.sees(authority=authority("", site.epoch + 1))
    assert site.stay(60) == []
    assert site.state.offered == {Action.ASK, Action.TAKE_OVER}


def test_another_station_of_the_same_person_is_named_as_such():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    taken_over(site, by="ann")
    assert "Another station" in site.state.event


def test_a_watching_operator_takes_over_with_a_reason_and_nothing_moves():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    taken_over(site)
    site.step(Action.TAKE_OVER, argument="bob has left")
    site.run_to(Phase.DECIDING)
    asked = site.requests(queries.ACQUIRE)[-1]
    assert (asked.take_over, asked.reason) == (True, "bob has left")
    assert site.names() == ["authority/acquire"] * 2
    assert site.state.held_epoch == site.epoch


def asking(site):
    """Bob commands, and is asked; the number of the request."""
    site.run_to(Phase.DECIDING)
    taken_over(site)
    site.step(Action.ASK)
    site.step()
    assert site.state.asks
    return site.state.asks


def commands(site, holder, operator, **told):
    """What the robot says of the authority from now on."""
    site.epoch += 1
    site.sees(authority=msgspec.structs.replace(authority(holder, site.epoch, operator), **told))


def test_whoever_commands_is_asked_and_the_robot_is_not():
    site = Site(BY_HAND)
    number = asking(site)
    site.sees(authority=msgspec.structs.replace(site.view.authority, asked=number, asked_by="ann", asked_left=7.2))
    assert site.stay(60) == []
    assert site.state.asks == number
    assert site.state.offered == {Action.TAKE_OVER}
    assert "bob is asked for the robot, and gives it by silence in 8 s." in text(site)


def test_who_is_given_the_authority_gets_it_and_nothing_moves():
    site = Site(BY_HAND)
    asking(site)
    commands(site, "station", "ann", event=AuthorityEvent.GIVEN)
    site.run_to(Phase.DECIDING)
    assert site.names() == ["authority/acquire"] * 2
    assert not site.requests(queries.ACQUIRE)[-1].take_over
    assert site.state.held_epoch == site.epoch
    assert not site.state.asks


def test_who_asks_gets_the_authority_once_nobody_has_it():
    site = Site(BY_HAND)
    asking(site)
    commands(site, "", "", event=AuthorityEvent.RELEASED)
    site.run_to(Phase.DECIDING)
    assert site.state.held_epoch == site.epoch


def test_who_asks_and_leaves_gets_nothing_by_itself():
    site = Site(BY_HAND)
    asking(site)
    commands(site, "", "", event=AuthorityEvent.RELEASED)
    assert site.stay(present=False) == []
    assert site.state.phase is Phase.WATCHING


def test_who_asks_and_is_refused_is_told_and_may_ask_again():
    site = Site(BY_HAND)
    number = asking(site)
    site.sees(authority=msgspec.structs.replace(site.view.authority, kept_from=number))
    site.step()
    assert not site.state.asks
    assert "bob keeps the authority." in text(site)
    assert site.stay() == []
    site.step(Action.ASK)
    assert site.state.asks not in (0, number)


def test_a_robot_that_refuses_is_quoted_and_watched_on():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    taken_over(site)
    site.fail(queries.ACQUIRE, queries.Refused("a take-over needs a reason"))
    site.step(Action.TAKE_OVER)
    site.run_to(Phase.WATCHING)
    assert "a take-over needs a reason" in site.state.notice
    assert site.stay() == []


def test_a_stop_ends_the_asking():
    site = Site(BY_HAND)
    asking(site)
    site.step(safety=STOPPED)
    assert not site.state.asks
    site.sees(authority=authority("", site.epoch + 1))
    assert site.stay() == []
    assert site.state.phase is Phase.WATCHING


@pytest.mark.parametrize(
    ("told", "words"),
    [
        ({"event": AuthorityEvent.TAKEN_OVER, "reason": "it burns"}, "bob has taken the authority over: it burns"),
        ({"event": AuthorityEvent.GIVEN}, "bob asked for the authority, and was given it."),
        ({"event": AuthorityEvent.GIVEN_BY_SILENCE}, "got it as nobody answered."),
        ({"event": AuthorityEvent.ACQUIRED}, "bob has the authority now."),
    ],
)
def test_who_loses_the_authority_is_told_to_whom_and_why(told, words):
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    commands(site, "station-b", "bob", **told)
    site.step()
    assert words in site.state.event


REVOKED = {"event": AuthorityEvent.REVOKED, "by": "eve", "reason": "it is late"}


def test_a_revoked_authority_comes_back_upon_a_press_only():
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.step()
    asked = len(site.asked)
    site.robot(phase=HOLD, waiting=True)
    commands(site, "", "", **REVOKED)
    site.step()
    assert site.state.phase is Phase.WATCHING
    assert "eve has revoked the authority: it is late" in text(site)
    assert site.stay(60) == []
    site.step(Action.ASK)
    site.run_to(Phase.EXECUTING)
    site.step()
    assert site.names()[asked:] == ["authority/acquire"]
    assert site.state.offered == {Action.GO_ON, Action.FINISH}


def test_a_station_that_comes_after_a_revocation_asks_for_nothing_by_itself():
    site = Site(BY_HAND)
    commands(site, "", "", **REVOKED)
    assert site.stay(60) == []
    assert site.state.phase is Phase.WATCHING


def test_a_script_ends_with_a_revocation():
    site = Site(SCRIPTED)
    site.run_to(Phase.EXECUTING)
    commands(site, "", "", **REVOKED)
    site.run_to(Phase.FINISHED)
    assert "eve has revoked the authority: it is late" in site.state.reason


def test_an_absent_operator_asks_for_nothing():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    taken_over(site)
    site.step(Action.TAKE_OVER, present=False)
    assert site.state.phase is Phase.WATCHING
    assert site.state.offered == frozenset(), "what would not count is not offered"
    site.step()
    assert site.state.offered == {Action.ASK, Action.TAKE_OVER}


def test_a_station_that_watched_watches_on_after_a_stop_and_its_release():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    taken_over(site)
    site.step(safety=STOPPED)
    site.sees(authority=authority("", site.epoch + 1))
    site.run_to(Phase.WATCHING)
    assert site.stay() == []


def test_a_script_asks_again_once_nobody_commands():
    site = Site(SCRIPTED)
    site.run_to(Phase.EXECUTING)
    asked = len(site.asked)
    taken_over(site)
    assert site.stay(60) == []
    site.sees(authority=authority("", site.epoch + 1))
    site.epoch += 1
    site.run_to(Phase.EXECUTING)
    assert site.names()[asked] == "authority/acquire"


def test_a_new_station_waits_for_a_lease_that_runs_out_and_then_asks():
    site = Site(BY_HAND)
    site.sees(authority=authority("station-old", 7, "ann"))
    assert site.stay(2) == []
    site.sees(authority=authority("", 8))
    site.epoch = 8
    site.run_to(Phase.DECIDING)


def test_a_lease_that_lasts_for_two_seconds_is_somebodys():
    site = Site(BY_HAND)
    site.sees(authority=authority("station-old", 7, "ann"))
    site.stay(2)
    assert site.state.phase is Phase.WAITING
    assert text(site) == "Another station commands the robot."
    site.step()
    assert site.state.phase is Phase.WATCHING


def test_a_lease_that_may_run_out_is_waited_for_after_a_stop_too():
    site = Site(BY_HAND)
    site.sees(authority=authority("station-old", 7, "ann"))
    site.step(safety=STOPPED)
    site.step()
    assert site.state.phase is Phase.WAITING
    site.step()
    assert site.state.phase is Phase.WAITING


def test_a_new_station_watches_where_somebody_commands():
    site = Site(BY_HAND)
    site.sees(authority=authority("station-b", 7, "bob"))
    site.run_to(Phase.WATCHING)
    assert site.stay() == []
    assert "bob commands the robot" in text(site)


def test_a_new_station_that_watches_watches_on_after_a_stop():
    site = Site(BY_HAND)
    site.sees(authority=authority("station-b", 7, "bob"))
    site.run_to(Phase.WATCHING)
    site.step(safety=STOPPED)
    site.sees(authority=authority("", 8))
    assert site.stay() == []
    assert site.state.phase is Phase.WATCHING
