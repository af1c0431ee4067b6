"""The method's region: what is chosen, what can be chosen, and the waypoints."""

import pytest
from views import POSE, shown, teaching

from protocol.messages import Method, ModelState, Origin, Waypoint
from services.station.page.methods import EDITS, METHODS, methods
from services.station.words.table import speech

HERE = Waypoint(POSE.position, POSE.orientation)


def test_before_the_workflow_is_heard_nothing_is_said():
    assert methods(shown()) == {}


@pytest.mark.parametrize("method", METHODS)
def test_the_chosen_method_is_pressed_and_no_other(method):
    values = methods(shown(teaching=teaching(actions=("method",), method=method)))
    pressed = {name for name, value in values.items() if name.endswith("aria-pressed") and value == "true"}
    assert pressed == {f"method-{method.value}@aria-pressed", "basis-model@aria-pressed"}
    assert values["method"] == speech.words[f"method.{method.value}"]
    assert not values["method-refine@disabled"]
    assert values["basis-model@disabled"]


def test_a_basis_is_there_where_there_is_something_to_choose():
    assert methods(shown(teaching=teaching()))["methods@data-based"] == "no"
    values = methods(shown(teaching=teaching(actions=("basis",), basis=Origin.REFINEMENT)))
    assert (values["methods@data-based"], values["basis-refinement@aria-pressed"]) == ("yes", "true")


def test_where_the_gripper_takes_part_a_waypoint_is_told_with_its_opening_in_millimetres():
    stored = tuple(Waypoint(POSE.position, POSE.orientation, opening) for opening in (0.08, 0.0))
    values = methods(shown(teaching=teaching(method=Method.WAYPOINTS, waypoints=stored)))
    assert values["waypoints@data-places"] == "0 0 0 80;0 0 0 0"


def test_waypoints_are_told_in_centimetres_with_what_can_be_done():
    values = methods(shown(teaching=teaching(method=Method.WAYPOINTS, waypoints=(HERE, HERE), actions=EDITS)))
    assert values["waypoints@data-places"] == "0 0 0;0 0 0"
    assert values["waypoints@data-edits"].split() == list(EDITS)
    assert values["waypoints-count"].endswith("2")
    assert values["action-clear@disabled"]


def test_a_method_that_cannot_be_used_says_why():
    model = ModelState(kind="adaptive", version=0, demonstrations=0, updates=0, scene="table")
    values = methods(shown(teaching=teaching(actions=("method",), method=Method.WAYPOINTS), model=model))
    assert values["method-refine@disabled"]
    assert "no motion to correct" in values["method-refine@title"]
    assert not values["method-waypoints@disabled"]
    known = methods(shown(teaching=teaching(actions=("method",))))
    assert (known["method-refine@disabled"], known["method-refine@title"]) == (False, "")


@pytest.mark.parametrize("method", METHODS)
def test_the_hints_say_what_becomes_of_the_gripper_where_all_is_let_go(method):
    values = methods(shown(teaching=teaching(method=method)))
    for pad in ("keyboard-help", "pointer-help"):
        assert ("return" in values[pad].rpartition("et go")[2]) is (method is Method.REFINE)
