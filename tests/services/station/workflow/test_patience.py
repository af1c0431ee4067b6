"""How long is waited for pictures, for a robot that does not answer or does not end, and how often is asked."""

import msgspec
import pytest

from protocol import queries
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from tests.services.station.workflow.site import BY_HAND, HOLD, SCRIPTED, UNANSWERED, Site, authority, lose_authority


def after(action, phase, settings=BY_HAND):
    site = Site(settings)
    site.press(action, phase)
    return site


@pytest.mark.parametrize(("late_s", "counts"), [(0.79, False), (0.81, True)])
def test_a_sighting_counts_from_eight_tenths_of_a_second_after_the_reset(late_s, counts):
    site = after(Action.EXECUTE, Phase.LOOKING)
    since_s = site.now_s
    site.stay(5, seen_s=since_s + late_s)
    assert (site.state.phase is not Phase.LOOKING) is counts


@pytest.mark.parametrize(("pictures", "counts"), [(4, False), (5, True)])
def test_a_sighting_of_fewer_than_five_pictures_does_not_count(pictures, counts):
    site = after(Action.EXECUTE, Phase.LOOKING)
    site.step(seen=msgspec.structs.replace(site.view.seen, pictures=pictures))
    assert (site.state.phase is not Phase.LOOKING) is counts


def test_without_a_press_the_operator_is_asked_where_nothing_was_seen_for_three_seconds():
    site = Site(BY_HAND)
    site.run_to(Phase.LOOKING, seen=None)
    site.stay(2, seen=None)
    assert site.state.phase is Phase.LOOKING
    site.step(seen=None)
    assert site.state.phase is Phase.DECIDING


def test_an_object_that_is_not_seen_within_fifteen_seconds_of_the_reset_ends_the_press():
    site = after(Action.EXECUTE, Phase.LOOKING)
    site.stay(14, seen=None)
    assert site.state.phase is Phase.LOOKING
    site.step(seen=None)
    assert site.state.phase is Phase.DECIDING
    assert not site.state.pressed
    assert site.stay() == []


def test_a_scripts_episode_that_has_not_ended_45_s_after_its_motion_is_repeated():
    site = Site(SCRIPTED)
    site.run_to(Phase.EXECUTING)
    site.step(seconds=SCRIPTED.autonomous_s + 45.0)
    assert site.state.phase is Phase.EXECUTING
    asked = len(site.asked)
    site.step()
    assert site.state.phase is Phase.DECIDING
    site.run_to(Phase.EXECUTING)
    assert site.names()[asked:] == ["cmd/finish", "cmd/reset", "model/predict", "cmd/execute"]


def test_a_script_s_episode_ends_in_time_although_its_authority_comes_and_goes():
    site = Site(SCRIPTED)
    site.run_to(Phase.EXECUTING)
    began_s = site.now_s
    while site.state.phase is not Phase.DECIDING and site.now_s < began_s + 600.0:
        site.robot(phase=HOLD, waiting=True)
        lose_authority(site)
        site.run_to(Phase.EXECUTING)
        site.step(seconds=5.0)
    assert site.now_s - began_s <= SCRIPTED.autonomous_s + 60.0


def test_an_episode_that_does_not_end_before_the_reset_is_told_to_every_half_second():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    site.robot(phase=HOLD)
    site.step(Action.EXECUTE)
    asked = []
    for _ in range(4):
        site.instead[queries.FINISH.name] = UNANSWERED
        site.step(seconds=0.25)
        asked.append(site.names().count("cmd/finish"))
    assert asked == [1, 1, 2, 2]


@pytest.mark.parametrize("query", [queries.RESET, queries.PREDICT, queries.EXECUTE])
def test_what_was_refused_is_asked_again_after_half_a_second(query):
    site = Site(BY_HAND)
    site.fail(query, queries.Refused("not yet"))
    site.press(
        Action.EXECUTE,
        {"cmd/execute": Phase.STARTING, "model/predict": Phase.PREDICTING}.get(query.name, Phase.RESETTING),
    )
    site.step()
    site.step()
    assert "not yet" in site.state.notice
    asked = len(site.asked)
    site.step(seconds=0.25)
    assert len(site.asked) == asked
    site.step(seconds=0.25)
    assert len(site.asked) == asked + 1


def test_a_script_asks_a_robot_that_waits_to_go_on_every_half_second():
    site = Site(SCRIPTED)
    site.run_to(Phase.EXECUTING)
    site.robot(phase=HOLD, waiting=True)
    site.step()
    site.step(seconds=0.25)
    asked = []
    for _ in range(4):
        site.step(seconds=0.25)
        asked.append(site.names().count("cmd/resume"))
    assert asked == [1, 2, 2, 2]
    assert all(isinstance(request, queries.Resume) for request in site.requests(queries.RESUME))


def test_an_authority_that_was_refused_is_asked_for_again_after_half_a_second():
    site = Site(BY_HAND)
    site.fail(queries.ACQUIRE, queries.Refused("not yet"))
    site.run_to(Phase.ACQUIRING)
    site.run_to(Phase.WAITING)
    site.step(seconds=0.25)
    assert site.state.phase is Phase.WAITING
    site.step(seconds=0.25)
    assert site.state.phase is Phase.ACQUIRING


def test_a_script_that_watches_and_was_refused_asks_again_after_half_a_second():
    site = Site(SCRIPTED)
    site.run_to(Phase.DECIDING)
    site.sees(authority=authority("station-b", site.epoch + 1, "bob"))
    site.run_to(Phase.WATCHING)
    site.sees(authority=authority("", site.epoch + 2))
    site.fail(queries.ACQUIRE, queries.Refused("not yet"))
    site.run_to(Phase.ACQUIRING)
    site.run_to(Phase.WATCHING)
    site.step(seconds=0.25)
    assert site.state.phase is Phase.WATCHING
    site.step(seconds=0.25)
    assert site.state.phase is Phase.ACQUIRING
