"""What is set once and for all is not the operator's choice: the method, what corrections start from, the place."""

from dataclasses import replace

from protocol.messages import Method, Mode, Origin, Part
from services.station.workflow.action import CHANGES, Action
from services.station.workflow.state import Phase
from services.station.workflow.words import teaching_state
from tests.services.station.workflow.site import BY_HAND, COLLIDED, REACHED, Site

PLACE = (0.85, 0.05, 0.5)


def decides(*verdicts, **settled):
    """A run whose operator is asked."""
    site = Site(replace(BY_HAND, **settled), verdicts)
    site.run_to(Phase.DECIDING)
    site.step()
    return site


def told(site):
    return teaching_state(site.state, site.view, site.settings)


def does(site, action):
    """Press it, and come to where the operator is asked again."""
    site.press(action, Phase.EXECUTING)
    site.step()
    site.run_to(Phase.DECIDING)
    site.step()


def test_the_only_method_is_the_one_that_is_set():
    site = decides(method=Method.DEMONSTRATE)
    assert told(site).method is Method.DEMONSTRATE
    assert Action.METHOD not in site.state.offered
    assert Action.LEAD in site.state.offered
    site.step(Action.METHOD, argument="refine")
    assert told(site).method is Method.DEMONSTRATE


def test_corrections_start_from_what_is_set_as_soon_as_there_is_one():
    site = decides(COLLIDED, COLLIDED, basis="refinement")
    does(site, Action.EXECUTE)
    does(site, Action.REFINE)
    assert Action.BASIS not in site.state.offered
    assert site.state.approach.basis is Origin.REFINEMENT


def test_with_one_place_there_is_no_other_and_no_end_and_the_robot_is_watched_again():
    site = decides(REACHED, place=PLACE)
    assert not {Action.NEXT, Action.END} & site.state.offered
    does(site, Action.EXECUTE)
    assert site.state.mode is Mode.AUTONOMOUS
    assert told(site).recommended == Action.EXECUTE.value


def test_where_all_is_fixed_nothing_is_changed_nor_offered_to_be():
    site = decides(COLLIDED, REACHED, fixed=True)
    does(site, Action.EXECUTE)
    site.step(Action.PACE, argument="2.0")
    site.step(Action.PART, argument="0.2 0.6")
    site.step(Action.CONFIDENCE, argument="0.1")
    assert (told(site).pace, told(site).part, told(site).confidence) == (1.0, Part(), site.settings.alpha)
    does(site, Action.REFINE)
    site.step(Action.UNDO)
    assert site.state.phase is Phase.DECIDING
    assert not {change.value for change in CHANGES} & set(told(site).actions)


def test_where_all_is_fixed_a_motion_under_way_is_neither_paused_nor_led_back():
    site = decides(fixed=True)
    site.press(Action.EXECUTE, Phase.EXECUTING)
    for press in (Action.PAUSE, Action.STEP_BACK, Action.SEEK):
        site.step(press, argument="0.1")
        assert site.state.going is None
    assert not CHANGES & site.state.offered
