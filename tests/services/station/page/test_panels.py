"""What the page tells: the light, the live view, how far a motion is, the verdict."""

from dataclasses import replace

import pytest
from views import SEATED, robot, shown, teaching

from protocol.messages import (
    Light,
    Mode,
    Phase,
    Pose,
    Recording,
    RobotState,
    Role,
    SafetyState,
    TeachingState,
    Unmet,
    Verdict,
)
from services.station.page.identity import Identity
from services.station.page.panels import counters, scene, traffic_light, verdict
from services.station.words.table import say

LOOKING_ON = replace(SEATED, armed=False)
NOT_COUNTING = replace(SEATED, let_go=True)


@pytest.mark.parametrize(
    ("light", "word"),
    [(Light.RED, "Watch"), (Light.AMBER, "Wait"), (Light.HOLD, "Paused"), (Light.GREEN, "Your turn")],
)
def test_the_light_is_the_workflow_s_for_who_has_the_input(light, word):
    values = traffic_light(shown(teaching=teaching(light)), SEATED)
    assert (values["light@data-light"], values["light-word"]) == (light.value, word)
    assert values["light-text"] == "so it is"


def test_before_the_workflow_is_heard_the_light_is_off():
    assert traffic_light(shown(), SEATED)["light@data-light"] == "off"


def test_the_light_is_not_green_while_the_keys_do_not_count():
    values = traffic_light(shown(teaching=teaching()), NOT_COUNTING)
    assert (values["light@data-light"], values["light-text"]) == ("hold", "Your keys do not count yet.")


@pytest.mark.parametrize(("light", "phase"), [(Light.GREEN, "deciding"), (Light.RED, "executing")])
def test_keys_that_do_not_count_matter_only_where_they_would_steer(light, phase):
    values = traffic_light(shown(teaching=teaching(light, phase)), NOT_COUNTING)
    assert values["light@data-light"] == light.value


def test_the_light_is_not_green_for_who_looks_on():
    values = traffic_light(shown(teaching=teaching()), LOOKING_ON)
    assert (values["light@data-light"], values["light-text"]) == ("red", "Whoever has the input acts.")


@pytest.mark.parametrize(
    ("role", "words"), [(Role.OPERATOR, "Nobody has the input: ask for it."), (Role.OBSERVER, "Nobody has the input.")]
)
def test_where_nobody_has_the_input_any_more_nobody_is_told_to_keep_its_page_in_view(role, words):
    nobody = replace(LOOKING_ON, vacant=True, identity=Identity("carl", role))
    waits = TeachingState(phase="waiting", text=say("waiting.operator"), light=Light.AMBER)
    for state, light in ((waits, "amber"), (teaching(), "red")):
        values = traffic_light(shown(teaching=state), nobody)
        assert (values["light-text"], values["light@data-light"]) == (words, light)
    for_the_robot = TeachingState(phase="waiting", text="Waiting for the robot.", light=Light.AMBER)
    assert traffic_light(shown(teaching=for_the_robot), nobody)["light-text"] == "Waiting for the robot."


def test_while_the_stop_is_latched_the_light_says_stopped():
    view = shown(teaching=teaching(Light.RED), safety=SafetyState(emergency_stop=True))
    assert traffic_light(view, SEATED)["light-word"] == "Stopped"


def test_it_is_told_where_everything_can_be_inspected_and_what_is_wrong_with_the_recording():
    recording = Recording(path="a", viewer_url="http://0.0.0.0:9/", recording_id="r", fault="The disk is full.")
    values = scene(shown(recording=recording, robot_age_s=9.0))
    assert values["inspect@data-address"] == "http://0.0.0.0:9/"
    assert values["recording-fault"] == "The disk is full."
    assert (values["scene@data-stale"], values["stale"]) == ("yes", "Robot data has not come yet")


@pytest.mark.parametrize(
    ("mode", "words"), [(Mode.AUTONOMOUS, "travelled"), (Mode.REFINE, "correction"), (Mode.TEACH, "led by hand")]
)
def test_the_way_is_called_after_who_shaped_it(mode, words):
    pose = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
    values = scene(shown(robot=RobotState(measured=pose, reference=pose, phase=Phase.EXECUTE, mode=mode)))
    assert (values["legend-way"], values["scene@data-way"]) == (words, mode.value)
    assert scene(shown())["legend-way"] == "travelled"


def test_the_counters_tell_used_and_allowed():
    values = counters(shown(teaching=teaching(refinements=3, refinements_allowed=10, updates_allowed=0)))
    assert (values["refinements"], values["refinements-bar@--used"]) == ("3 of 10", "3")
    assert (values["updates"], values["updates-bar@--allowed"]) == ("0 of 0", "1")


def test_the_verdict_is_told_criterion_by_criterion():
    judged = Verdict(reached=True, kicked_over=True, collision=False, missed=0.0314)
    values = verdict(shown(verdict=judged))
    tones = [values[f"{name}@data-tone"] for name in ("verdict", "reached", "kicked", "collision")]
    assert tones == ["bad", "good", "bad", "good"]
    assert values["reached-evidence"] == "31 mm from the target"


def test_a_motion_that_was_only_led_has_no_verdict():
    missed = Verdict(reached=False, kicked_over=False, collision=False, missed=0.2)
    values = verdict(shown(verdict=missed, robot=robot(Phase.IDLE), teaching=teaching(led=True)))
    assert (values["verdict@data-tone"], values["reached@data-tone"]) == ("none", "none")
    assert values["outcome"].startswith("No verdict")


def test_what_else_the_task_asks_for_stands_beside_how_far_the_target_was_missed():
    judged = Verdict(reached=False, kicked_over=False, collision=False, missed=0.0314, unmet=(Unmet.LIFTED,))
    assert verdict(shown(verdict=judged))["reached-evidence"] == "31 mm from the target, not lifted"


def test_a_robot_that_does_not_tell_how_far_the_target_was_missed_is_not_spoken_for():
    judged = Verdict(reached=False, kicked_over=False, collision=False)
    assert verdict(shown(verdict=judged))["reached-evidence"] == ""
