"""What the page shows of the guide through an empty skill's first motions."""

from itertools import combinations

import pytest

from protocol.messages import Light, Showing, ShowStep
from services.station.page.controls import BUTTONS, actions
from services.station.page.guide import STEPS, guide
from tests.services.station.page.views import shown, teaching

OFFERED = {
    ShowStep.PLACE: ("put", "other_place", "enough", "end"),
    ShowStep.SHOW: ("lead", "other_place", "store", "end"),
    ShowStep.REPLAY: ("execute", "repeat", "lead", "store", "end"),
    ShowStep.KEEP: ("teach", "execute", "repeat", "lead", "end"),
}


def told(step, actions=()):
    return shown(teaching=teaching(Light.GREEN, "deciding", showing=Showing(step, 1, 2), actions=actions))


def test_a_skill_that_has_its_first_motions_is_led_through_none():
    assert guide(shown(teaching=teaching())) == guide(shown()) == {"showing@hidden": True}


@pytest.mark.parametrize("step", ShowStep)
def test_each_step_is_done_or_next_or_to_come(step):
    values = guide(told(step))
    states = [values[f"showing-{name}@data-state"] for name in STEPS]
    now = list(ShowStep).index(step)
    assert states == ["done"] * now + ["now"] + ["later"] * (3 - now)
    assert values["showing-of"] == "Place 1 of 2"


@pytest.mark.parametrize("step", ShowStep)
def test_no_two_buttons_of_a_step_have_the_same_place(step):
    places = {button.action: button.place for button in BUTTONS}
    assert all(places[one] != places[other] for one, other in combinations(OFFERED[step], 2))


def test_what_is_kept_and_done_alone_is_called_so():
    words = actions(told(ShowStep.KEEP, ("teach", "execute")))
    assert (words["action-teach-label"], words["action-execute-label"]) == ("Keep it", "Replay")
    words = actions(shown(teaching=teaching()))
    assert (words["action-teach-label"], words["action-execute-label"]) == ("Teach this", "Execute")
