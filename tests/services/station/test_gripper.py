"""What the operator asks of the gripper, press by press."""

from dataclasses import replace

import msgspec
import pytest

from protocol.messages import AuthorityState, Mode, Phase
from services.station.gripper import GRIP, OPENING, Gripper
from services.station.press import Press
from tests.services.station.workflow.site import BY_HAND, Site

WIDE = 0.08
HOLDER = "station"


@pytest.fixture
def view():
    """A refinement under way, of a task in which the gripper takes part."""
    seen = Site(BY_HAND, []).view
    robot = msgspec.structs.replace(
        seen.robot, phase=Phase.EXECUTE, mode=Mode.REFINE, episode=1, opening=WIDE, opening_reference=WIDE
    )
    mine = AuthorityState(holder=HOLDER, epoch=1, expires_in=1.0)
    return replace(seen, robot=robot, authority=mine, scene=msgspec.structs.replace(seen.scene, wide_open=WIDE))


def robot(view, **changes):
    return replace(view, robot=msgspec.structs.replace(view.robot, **changes))


@pytest.fixture
def gripper(view):
    one = Gripper(HOLDER)
    one.hear([], view)
    return one


def later(view, seconds=1.0):
    return replace(view, now_s=view.now_s + seconds)


def asked(gripper, view, *presses):
    gripper.hear([Press(action, argument) for action, argument in presses], view)
    return gripper.asked


def test_the_first_press_closes_what_stands_open_and_opens_what_is_closed(gripper, view):
    assert asked(gripper, view) is None
    assert asked(gripper, view, (GRIP, "")) == 0.0
    assert asked(gripper, view, (GRIP, "")) == 1.0
    closed = Gripper(HOLDER)
    closed.hear([], view)
    assert asked(closed, robot(view, opening_reference=0.0, opening=0.04), (GRIP, "")) == 1.0


@pytest.mark.parametrize(
    ("said", "share"), [("0.25", 0.25), ("7", 1.0), ("-1", 0.0), ("nan", None), ("wide", None), ("", None)]
)
def test_a_slider_says_a_share_of_wide_open_and_nothing_else_counts(gripper, view, said, share):
    assert asked(gripper, view, (OPENING, said)) == share


def test_every_press_of_a_step_counts_in_its_order(gripper, view):
    assert asked(gripper, view, (OPENING, "0.4"), (GRIP, ""), (GRIP, "")) == 0.0


@pytest.mark.parametrize(
    "elsewhere",
    [
        {"phase": Phase.HOLD},
        {"phase": Phase.RAMP},
        {"mode": Mode.AUTONOMOUS},
    ],
)
def test_where_the_operator_leads_nothing_s_he_asks_for_nothing(gripper, view, elsewhere):
    assert asked(gripper, robot(view, **elsewhere), (GRIP, "")) is None


def test_without_the_authority_or_a_gripper_nothing_is_asked(gripper, view):
    other = AuthorityState(holder="other", epoch=2, expires_in=1.0)
    assert asked(gripper, replace(view, authority=other), (GRIP, "")) is None
    plain = replace(view, scene=msgspec.structs.replace(view.scene, wide_open=0.0))
    assert asked(gripper, plain, (GRIP, "")) is None


@pytest.mark.parametrize("lost", ["robot", "authority", "scene that takes long", "hold"])
def test_what_was_asked_stays_asked_through_whatever_is_lost(gripper, view, lost):
    asked(gripper, view, (GRIP, ""))
    there = {
        "robot": replace(view, robot=None),
        "authority": replace(view, authority=None),
        "scene that takes long": view,
        "hold": robot(view, phase=Phase.HOLD, waiting=True),
    }
    assert asked(gripper, there[lost]) == 0.0
    assert asked(gripper, view) == 0.0


def test_what_the_robot_does_stays_asked_and_what_it_does_not_is_over(gripper, view):
    asked(gripper, view, (GRIP, ""))
    assert asked(gripper, later(view, 0.1)) == 0.0, "the robot has not been heard to follow yet"
    closed = robot(view, opening_reference=0.0, opening=0.04)
    assert asked(gripper, later(closed)) == 0.0
    assert asked(gripper, later(view, 2.0)) is None, "its motion has gone on, and opens the gripper"
    assert asked(gripper, later(view, 2.1), (GRIP, "")) == 0.0


@pytest.mark.parametrize("after", [{"episode": 2}, {"publisher": 2}, {"phase": Phase.IDLE}, {"phase": Phase.STOPPED}])
def test_a_new_episode_begins_with_nothing_asked(gripper, view, after):
    asked(gripper, view, (GRIP, ""))
    assert asked(gripper, robot(view, **after)) is None
