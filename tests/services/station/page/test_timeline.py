"""The motion as a bar."""

import msgspec
import pytest
from views import shown, teaching

from protocol.messages import ExecutionState, Mode, Part, Phase, Pose, RobotState
from services.station.page.timeline import CONTROLS, timeline

POSE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
EXECUTION = ExecutionState(episode=1, mode=Mode.REFINE, prediction=1, progress=0.3)
ROBOT = RobotState(measured=POSE, reference=POSE, phase=Phase.EXECUTE, progress=0.42)


def test_without_a_motion_nothing_is_passed_and_nothing_goes():
    values = timeline(shown(teaching=teaching(), robot=ROBOT))
    assert (values["timeline@data-progress"], values["timeline@data-going"]) == ("0.000", "none")


@pytest.mark.parametrize(("pace", "going"), [(1.0, "on"), (0.25, "on"), (0.0, "paused"), (-1.0, "back")])
def test_it_shows_how_far_the_motion_is_and_which_way_it_goes(pace, going):
    execution = msgspec.structs.replace(EXECUTION, pace=pace)
    values = timeline(shown(teaching=teaching(), robot=ROBOT, execution=execution))
    assert (values["timeline@data-progress"], values["timeline@data-going"]) == ("0.420", going)


def test_the_part_the_pace_and_what_was_spoilt_are_shown():
    told = msgspec.structs.replace(teaching(), part=Part(0.25, 0.75), pace=0.5)
    values = timeline(shown(teaching=told, spoilt=(0.6,)))
    assert [values[f"timeline@data-{name}"] for name in ("first", "last", "pace", "spoilt")] == [
        "0.250",
        "0.750",
        "0.50",
        "0.600",
    ]


def test_only_what_is_offered_can_be_pressed():
    values = timeline(shown(teaching=msgspec.structs.replace(teaching(), actions=("pause", "pace"))))
    able = {name for name in CONTROLS if not values[f"action-{name}@disabled"]}
    assert able == {"pause", "pace"}
