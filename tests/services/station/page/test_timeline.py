"""The motion as a bar."""

import msgspec
import pytest
from views import shown, teaching

from protocol.messages import ExecutionState, Mode, Part, Phase, Pose, RobotState
from services.station.page.timeline import CONTROLS, timeline

POSE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
EXECUTION = ExecutionState(episode=1, mode=Mode.REFINE, prediction=1, progress=0.3)
ROBOT = RobotState(measured=POSE, reference=POSE, phase=Phase.EXECUTE, progress=0.42)


def test_without_a_motion_it_shows_how_far_the_last_one_was_and_nothing_goes():
    values = timeline(shown(teaching=teaching(), robot=ROBOT))
    assert (values["timeline@data-progress"], values["timeline@data-going"]) == ("0.420", "none")
    assert timeline(shown())["timeline-text"] == "0 % done"


@pytest.mark.parametrize(("share", "words"), [(0.404, "40 % done"), (1.2, "100 % done")])
def test_it_is_told_how_far_the_motion_is(share, words):
    values = timeline(shown(robot=msgspec.structs.replace(ROBOT, progress=share)))
    assert values["timeline-text"] == words
    assert f"{values['timeline-done@aria-valuenow']} % done" == words


@pytest.mark.parametrize(
    ("pace", "going", "words"),
    [
        (1.0, "on", "42 % done"),
        (0.25, "on", "42 % done"),
        (0.0, "paused", "paused at 42 %"),
        (-1.0, "back", "going back: 42 %"),
    ],
)
def test_it_shows_how_far_the_motion_is_and_which_way_it_goes(pace, going, words):
    execution = msgspec.structs.replace(EXECUTION, pace=pace)
    values = timeline(shown(teaching=teaching(), robot=ROBOT, execution=execution))
    assert (values["timeline@data-progress"], values["timeline@data-going"]) == ("0.420", going)
    assert values["timeline-text"] == words


def test_the_part_the_pace_and_what_was_spoilt_are_shown():
    told = msgspec.structs.replace(teaching(), part=Part(0.25, 0.75), pace=0.5)
    values = timeline(shown(teaching=told, spoilt=(0.6,)))
    assert [values[f"timeline@data-{name}"] for name in ("first", "last", "pace", "spoilt")] == [
        "0.250",
        "0.750",
        "0.50",
        "0.600",
    ]
    assert values["timeline-text"].endswith("corrections count from 25 % to 75 %")
    assert values["timeline-pace"] == "50 %"


def test_only_what_is_offered_can_be_pressed():
    values = timeline(shown(teaching=msgspec.structs.replace(teaching(), actions=("pause", "pace"))))
    able = {name for name in CONTROLS if not values[f"action-{name}@disabled"]}
    assert able == {"pause", "pace"}
