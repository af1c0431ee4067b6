"""Where another station commands this one watches: its operator asks or takes over, and nothing happens by itself."""

import pytest

from protocol import queries
from services.station.workflow.state import Action, Phase
from services.station.workflow.words import teaching_state
from tests.services.station.workflow.site import BY_HAND, SCRIPTED, STOPPED, Site, authority


def text(site):
    return teaching_state(site.state, site.view, site.settings).text


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


@pytest.mark.parametrize(("action", "take_over"), [(Action.ASK, False), (Action.TAKE_OVER, True)])
def test_a_watching_operator_asks_or_takes_over_and_nothing_moves(action, take_over):
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    taken_over(site)
    site.step(action)
    site.run_to(Phase.DECIDING)
    assert site.requests(queries.ACQUIRE)[-1].take_over is take_over
    assert site.names() == ["authority/acquire"] * 2
    assert site.state.held_epoch == site.epoch


def test_who_asks_and_is_refused_watches_on():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    taken_over(site)
    site.fail(queries.ACQUIRE, queries.Refused("bob holds it"))
    site.step(Action.ASK)
    site.run_to(Phase.WATCHING)
    assert "bob holds it" in site.state.notice
    assert site.stay() == []
    site.step(safety=STOPPED)
    site.sees(authority=authority("", site.epoch + 1))
    assert site.stay() == []
    assert site.state.phase is Phase.WATCHING


def test_an_absent_operator_asks_for_nothing():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    taken_over(site)
    site.step(Action.TAKE_OVER, present=False)
    assert site.state.phase is Phase.WATCHING


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
