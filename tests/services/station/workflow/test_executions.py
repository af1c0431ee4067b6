"""A skill that is executed so many times: each time at another place, whatever comes of it, and nothing is taught."""

from dataclasses import replace

from protocol import queries
from services.station.workflow.state import Phase
from tests.services.station.workflow.site import COLLIDED, MISSED, REACHED, SCRIPTED, STOPPED, Site

FOUR = replace(SCRIPTED, executions=4)
CHANGES = (queries.ADD_DEMONSTRATION, queries.UNDO, queries.REDO, queries.CHOOSE_SKILL)


def test_as_often_as_asked_for_each_time_at_another_place_and_nothing_is_changed():
    site = Site(FOUR, [COLLIDED, REACHED, MISSED, COLLIDED])
    site.run_to(Phase.FINISHED)
    assert [attempt.verdict for attempt in site.state.attempts] == [COLLIDED, REACHED, MISSED, COLLIDED]
    assert site.state.reason == "the skill was executed as often as was asked for"
    assert len(site.requests(queries.RESET)) >= 4
    assert [site.requests(query) for query in CHANGES] == [[]] * 4


def test_a_place_of_which_little_is_known_is_executed_all_the_same():
    site = Site(replace(SCRIPTED, executions=1), [REACHED])
    site.certainty = {"known": 0.1}
    site.run_to(Phase.FINISHED)
    assert len(site.state.attempts) == 1


def test_a_stop_ends_it_at_once():
    site = Site(FOUR, [REACHED] * 4)
    site.run_to(Phase.EXECUTING)
    site.sees(safety=STOPPED)
    site.run_to(Phase.FINISHED)
    assert "bob" in site.state.reason
    before = len(site.requests(queries.EXECUTE))
    site.stay(30)
    assert len(site.requests(queries.EXECUTE)) == before
