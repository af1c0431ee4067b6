"""An empty skill is shown its first motions, stepped by hand: place, show, replay, keep or repeat; twice."""

from dataclasses import replace

import msgspec
import pytest

from protocol import queries
from protocol.messages import Method, Mode, Origin, Purpose, Showing, ShowStep
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from tests.services.station.workflow.guided import FIRST, METHODS, SECOND, TRAINING, Guided, holding
from tests.services.station.workflow.person import EMPTY, MOVING, Teaching, shown_way
from tests.services.station.workflow.site import BY_HAND, COLLIDED, MISSED, REACHED, UNANSWERED


def test_an_empty_skill_asks_to_be_shown_and_moves_nothing_by_itself():
    site = Guided()
    assert site.told.showing == Showing(ShowStep.PLACE, 1, 2)
    assert "67 cm ahead and 4 cm left" in site.told.text
    assert site.told.recommended == "put"
    assert not MOVING & set(site.names())
    assert not {Action.LEAD, Action.EXECUTE, Action.NEXT, Action.ENOUGH} & site.state.offered


@pytest.mark.parametrize("method", METHODS)
def test_what_was_shown_is_seen_alone_and_then_kept_or_not(method):
    site = Guided(method)
    site.put()
    assert site.placed() == [FIRST]
    assert (site.at_step, site.told.recommended) == (ShowStep.SHOW, "lead")
    site = Guided(method)
    site.show()
    assert (site.at_step, site.told.recommended) == (ShowStep.REPLAY, "execute")
    assert Action.TEACH not in site.state.offered, "it is seen first"
    site.replay()
    (executed,) = site.requests(queries.EXECUTE)
    plan = site.requests(queries.PLAN)[-1]
    assert executed.mode is Mode.AUTONOMOUS
    assert plan.origin is (Origin.WAYPOINTS if method is Method.WAYPOINTS else Origin.DEMONSTRATION)
    assert (site.at_step, site.told.recommended) == (ShowStep.KEEP, "teach")
    assert site.requests(queries.ADD_DEMONSTRATION) == [], "nothing is kept unasked"
    site.keep()
    (kept,) = site.requests(queries.ADD_DEMONSTRATION)
    assert (kept.purpose, kept.method) == (Purpose.INITIAL, method)
    assert site.told.showing == Showing(ShowStep.PLACE, 2, 2)


@pytest.mark.parametrize("method", METHODS)
def test_after_two_places_the_loop_goes_on(method):
    site = Guided(method)
    site.teach()
    site.teach()
    assert set(site.placed()) == {FIRST, SECOND}
    assert [one.purpose for one in site.requests(queries.ADD_DEMONSTRATION)] == [Purpose.INITIAL] * 2
    assert site.told.showing is None
    assert (site.told.method, site.told.recommended) == (Method.REFINE, "execute")
    assert Action.REFINE in site.state.offered
    assert site.state.placed.object_position == SECOND, "it is seen alone where it was shown last"


@pytest.mark.parametrize("method", METHODS)
def test_to_repeat_drops_what_was_shown_and_moves_nothing(method):
    site = Guided(method)
    site.show()
    site.replay()
    before = site.names()
    site.step(Action.REPEAT)
    assert site.stay() == []
    assert site.names() == before
    assert (site.at_step, site.told.waypoints, site.state.taught) == (ShowStep.SHOW, (), None)
    assert site.told.showing.place == 1


@pytest.mark.parametrize(("outcome", "kept"), [(MISSED, True), (COLLIDED, False)])
def test_what_fails_alone_is_shown_again_first_and_kept_only_where_it_touched_nothing(outcome, kept):
    site = Guided()
    site.show()
    site.replay(outcome)
    assert site.told.recommended == "repeat"
    assert (Action.TEACH in site.state.offered) is kept
    assert {Action.REPEAT, Action.EXECUTE, Action.LEAD} <= site.state.offered


def test_other_waypoints_are_seen_alone_before_they_are_kept():
    site = Guided()
    site.put()
    site.lead()
    site.store(0.5, 0.6, 0.7, 0.8)
    site.finish()
    site.replay(MISSED)
    site.step(Action.DELETE, argument="2")
    site.decide()
    assert (site.at_step, site.told.recommended) == (ShowStep.REPLAY, "execute")
    assert Action.TEACH not in site.state.offered


def test_the_operator_may_take_another_place_and_never_gets_one_that_is_kept():
    site = Guided()
    site.press(Action.OTHER_PLACE, Phase.RESETTING)
    site.decide()
    assert (site.placed()[-1], site.at_step) == (SECOND, ShowStep.SHOW)
    site.lead()
    site.store(0.5, 0.6, 0.7)
    site.finish()
    site.replay()
    site.keep()
    site.sees(kept_at=(SECOND,))
    proposed = set()
    for _ in TRAINING:
        site.press(Action.OTHER_PLACE, Phase.RESETTING)
        site.decide()
        proposed.add(site.placed()[-1])
    assert proposed == {*TRAINING} - {SECOND}
    assert site.told.showing.place == 2


def test_with_one_motion_it_goes_on_where_the_operator_says_so():
    site = Guided()
    site.teach()
    assert Action.ENOUGH in site.state.offered
    site.step(Action.ENOUGH)
    site.decide()
    assert site.told.showing is None
    assert {Action.EXECUTE, Action.REFINE, Action.NEXT} <= site.state.offered
    site.stay()
    assert site.told.showing is None, "it is not asked again"


def test_a_station_that_comes_back_goes_on_at_the_place_where_it_stood():
    site = Guided(model=holding(1))
    assert site.told.showing == Showing(ShowStep.PLACE, 2, 2)
    site.sees(kept_at=(FIRST,))
    site.put()
    assert site.placed() == [SECOND]


def test_what_the_model_said_before_it_learnt_does_not_count():
    site = Guided()
    site.show()
    site.replay()
    site.press(Action.TEACH, Phase.LEARNING)
    site.run_to(Phase.DECIDING, model=EMPTY)
    site.step(model=EMPTY)
    assert site.told.showing.place == 2
    assert not site.state.empty


def test_a_model_that_dies_while_it_is_to_keep_a_motion_keeps_it_once():
    site = Guided()
    site.show()
    site.replay()
    site.fail(queries.ADD_DEMONSTRATION, UNANSWERED)
    site.press(Action.TEACH, Phase.LEARNING)
    site.stay(model=None)
    site.fail(queries.ADD_DEMONSTRATION)
    site.state = replace(site.state, question=0)
    site.decide()
    assert len({one.request for one in site.requests(queries.ADD_DEMONSTRATION)}) == 1
    assert site.told.showing == Showing(ShowStep.PLACE, 2, 2)


def test_a_first_motion_that_is_taken_back_is_shown_again():
    site = Guided()
    site.teach()
    site.teach()
    site.sees(model=holding(1, version=20))
    site.decide()
    assert site.told.showing == Showing(ShowStep.PLACE, 2, 2)


def test_another_skill_that_is_empty_begins_anew():
    site = Guided()
    site.put()
    assert site.at_step is ShowStep.SHOW
    site.sees(model=msgspec.structs.replace(EMPTY, skill="pour"))
    site.decide()
    assert site.told.showing == Showing(ShowStep.PLACE, 1, 2)
    site.sees(model=msgspec.structs.replace(holding(2), skill="wipe", version=1))
    site.decide()
    assert site.told.showing is None


@pytest.mark.parametrize(
    ("model", "training"),
    [(holding(2), TRAINING), (holding(1, updates=1), TRAINING), (holding(1), TRAINING[:1])],
    ids=["as many as are shown", "corrected since", "of a task with one place"],
)
def test_a_skill_that_has_its_first_motions_is_not_asked_for_them(model, training):
    site = Guided(Method.REFINE, model, training)
    assert site.told.showing is None
    assert Action.EXECUTE in site.state.offered


def test_where_all_is_set_beforehand_nobody_is_led_through_places():
    site = Guided(settings=replace(BY_HAND, place=(0.85, 0.05, 0.5)))
    assert site.told.showing is None
    assert Action.LEAD in site.state.offered


def test_first_motions_that_somebody_else_teaches_end_it():
    site = Guided()
    assert site.told.method is Method.WAYPOINTS
    site.sees(model=holding(4))
    site.decide()
    assert (site.told.showing, site.told.method) == (None, Method.REFINE)


def test_a_demonstration_of_a_skill_that_can_already_is_seen_alone_as_well():
    site = Teaching(Method.DEMONSTRATE)
    site.lead()
    site.finish(REACHED, commanded=shown_way())
    assert {Action.TEACH, Action.EXECUTE} <= site.state.offered
    site.press(Action.EXECUTE, Phase.EXECUTING)
    assert site.requests(queries.PLAN)[-1].origin is Origin.DEMONSTRATION
    site.executed(REACHED)
    site.decide()
    (learnt,) = site.requests(queries.ADD_DEMONSTRATION)
    assert (learnt.method, learnt.purpose) == (Method.DEMONSTRATE, Purpose.UPDATE)
