"""The page's region of the gripper."""

import msgspec
import pytest
from views import shown

from protocol.messages import Mode, Phase, Pose, RobotState
from services.station.page.gripper import gripper

POSE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
WIDE = 0.08
ROBOT = RobotState(
    measured=POSE,
    reference=POSE,
    phase=Phase.EXECUTE,
    mode=Mode.REFINE,
    opening=0.0385,
    opening_reference=0.0,
    grasped=True,
)
OPEN = msgspec.structs.replace(ROBOT, opening=WIDE, opening_reference=WIDE, grasped=False)


def values(robot=ROBOT, **view):
    return gripper(shown(**{"robot": robot, "wide_open": WIDE, "authority_is_mine": True, **view}))


@pytest.mark.parametrize("without", [{"wide_open": 0.0}, {"robot": None}])
def test_where_it_takes_no_part_it_is_not_there(without):
    assert values(**without) == {"gripper@hidden": True}


def test_what_was_asked_stands_beside_what_was_measured_and_what_is_held():
    told = values(opening=0.0)
    assert told["gripper-text"] == "asked 0 mm, is 38 mm, holds"
    assert (told["gripper@data-asked"], told["gripper@data-share"]) == ("yes", "0.000")
    assert (told["gripper-measured@--at"], told["gripper@data-holds"]) == ("0.481", "yes")


def test_where_nothing_was_asked_it_moves_with_the_motion():
    told = values(OPEN)
    assert told["gripper-text"] == "with the motion: 80 mm"
    assert (told["gripper@data-asked"], told["gripper@data-share"]) == ("no", "1.000")


@pytest.mark.parametrize(("opening", "does"), [(None, "Open"), (0.0, "Open"), (1.0, "Close"), (0.6, "Close")])
def test_its_button_says_what_a_press_would_do(opening, does):
    assert values(opening=opening)["gripper-does"] == does


@pytest.mark.parametrize(
    ("view", "able"),
    [
        ({}, True),
        ({"authority_is_mine": False}, False),
        ({"robot": msgspec.structs.replace(ROBOT, phase=Phase.HOLD)}, False),
        ({"robot": msgspec.structs.replace(ROBOT, mode=Mode.AUTONOMOUS)}, False),
        ({"robot": msgspec.structs.replace(ROBOT, mode=Mode.TEACH)}, True),
    ],
)
def test_it_is_pressed_and_slid_where_the_operator_leads(view, able):
    told = values(**view)
    assert [told[f"action-{name}@disabled"] for name in ("grip", "opening")] == [not able] * 2
