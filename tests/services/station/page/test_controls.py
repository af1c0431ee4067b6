"""What is pressed on the page: keys, buttons, the emergency stop."""

from dataclasses import replace

import msgspec
import pytest
from views import POSE, SEATED, shown, teaching

from protocol.keys import PUSH_KEYS, TURN_KEYS
from protocol.messages import MOST_WAYPOINTS, Light, SafetyState
from services.bus.arrays import motion_to_wire
from services.station.page import history, methods, skills
from services.station.page.controls import BUTTONS, KEYBOARDS, actions, emergency_stop
from services.station.page.timeline import CONTROLS
from services.station.workflow.action import Action
from tests.services.predictions import prediction

MOTION = motion_to_wire([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[1.0, 0.0, 0.0, 0.0]] * 2, 1.0)
PRESSED = replace(SEATED, stop_pressed=True)
LATCHED = SafetyState(emergency_stop=True, by="anna", reason="too fast", at="2026-11-25T10:00:05Z")
STANDING = SafetyState(emergency_stop=True, by="anna", standing=True)
RELEASED = SafetyState(emergency_stop=False, released_by="bert", at="2026-11-25T10:00:05Z", standing=True)


def first(values):
    """The actions that stand out."""
    return [name.split("-")[1].split("@")[0] for name, value in values.items() if value == "yes"]


def test_the_page_shows_the_very_keys_that_the_device_obeys():
    pushing, turning = [[key for row in rows for key in row] for rows in KEYBOARDS]
    assert {key.code for key in pushing} == set(PUSH_KEYS)
    assert {key.code for key in turning} == set(TURN_KEYS)
    for key in pushing:
        axis, sign = PUSH_KEYS[key.code]
        assert key.axis == ("+" if sign > 0 else "\N{MINUS SIGN}") + "xyz"[axis]


def test_a_waypoint_more_is_offered_only_where_there_is_room_for_it():
    for count, full in ((MOST_WAYPOINTS - 1, False), (MOST_WAYPOINTS, True)):
        values = actions(shown(teaching=teaching(actions=("store",), waypoints=(POSE,) * count)))
        assert values["action-store@disabled"] is full


def test_a_release_of_before_the_robot_was_started_says_so():
    told = [
        emergency_stop(shown(safety=msgspec.structs.replace(RELEASED, earlier=earlier)), SEATED)["stop-released"]
        for earlier in (False, True)
    ]
    assert told == ["Released by bert", "Before the robot was started, released by bert"]


def test_every_action_of_the_workflow_has_a_button():
    elsewhere = {Action.RELEASE_STOP.value, *CONTROLS, *history.CONTROLS, *methods.CONTROLS, *skills.CONTROLS}
    assert {action.value for action in Action} <= {button.action for button in BUTTONS} | elsewhere


def test_a_button_can_be_pressed_where_the_workflow_offers_it():
    values = actions(shown(teaching=teaching(actions=("finish", "undo"))))
    assert {name for name, disabled in values.items() if disabled is False} == {
        "action-finish@disabled",
        "action-undo@disabled",
    }


def test_before_the_workflow_is_heard_no_button_can_be_pressed():
    assert all(actions(shown()).values())


def test_what_is_recommended_stands_out():
    values = actions(shown(teaching=teaching(actions=("execute", "refine"), recommended="refine")))
    assert first(values) == ["refine"]
    assert first(actions(shown())) == []


@pytest.mark.parametrize(
    ("light", "offered", "expected"),
    [
        (Light.GREEN, ("finish",), ["finish"]),
        (Light.HOLD, ("finish", "go_on"), ["go_on"]),
        (Light.AMBER, ("ask", "take_over"), ["ask"]),
        (Light.AMBER, ("next",), ["next"]),
        (Light.RED, ("finish",), []),
    ],
)
def test_where_the_workflow_recommends_nothing_one_thing_stands_out_but_where_one_watches(light, offered, expected):
    assert first(actions(shown(teaching=teaching(light, actions=offered)))) == expected


@pytest.mark.parametrize(
    ("standing", "safety", "state"),
    [
        (SEATED, None, "ready"),
        (SEATED, SafetyState(emergency_stop=False), "ready"),
        (SEATED, RELEASED, "ready"),
        (PRESSED, None, "unconfirmed"),
        (PRESSED, SafetyState(emergency_stop=False, standing=True), "unconfirmed"),
        (PRESSED, LATCHED, "moving"),
        (SEATED, LATCHED, "moving"),
        (PRESSED, STANDING, "stopped"),
        (SEATED, STANDING, "stopped"),
    ],
)
def test_a_stop_is_shown_as_far_as_the_robot_has_confirmed_it(standing, safety, state):
    assert emergency_stop(shown(safety=safety), standing)["stop@data-stop"] == state


def test_who_stopped_and_why_and_when_is_told():
    values = emergency_stop(shown(safety=LATCHED), SEATED)
    assert (values["stop-reason"], values["stop-reason@data-at"]) == ("anna: too fast", LATCHED.at)
    assert values["stop-unconfirmed"] == "It is latched, but the arm still moves."
    assert values["stop-released"] == ""


def test_who_released_and_when_is_told():
    values = emergency_stop(shown(safety=RELEASED), SEATED)
    assert (values["stop-released"], values["stop-released@data-at"]) == ("Released by bert", RELEASED.at)


@pytest.mark.parametrize(
    ("recommended", "known", "label"),
    [("refine", 0.2, "Show me"), ("refine", 0.5, "Correct"), ("execute", 0.2, "Correct")],
)
def test_where_little_is_known_the_page_asks_to_be_shown(recommended, known, label):
    view = shown(
        teaching=teaching(actions=("execute", "refine"), recommended=recommended),
        prediction=msgspec.structs.replace(prediction(MOTION), known=known),
    )
    assert actions(view)["action-refine-label"] == label
