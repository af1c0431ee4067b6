"""What the operator asks of the gripper goes on to the robot, and is not lost with anything else."""

import msgspec
import pytest

from protocol.messages import AuthorityState, Phase
from tests.services.master.test_service import REFINING, Desk

NEXT = msgspec.structs.replace(REFINING, episode=2)


@pytest.fixture
def desk():
    desk = Desk()
    desk.run(0.1, keys=())
    return desk


def test_until_something_is_asked_it_is_left_to_the_motion(desk):
    assert desk.run(0.1).opening is None


@pytest.mark.parametrize(
    "lost",
    [
        {"focused": False, "opening": 0.25},
        {"page": False},
        {"authority": None, "opening": 0.25},
        {"authority": AuthorityState(holder="station-b", epoch=8, expires_in=1.0)},
    ],
    ids=["focus", "link", "robot's word", "authority"],
)
def test_what_was_asked_stays_asked_through_whatever_is_lost(desk, lost):
    assert desk.run(0.1, opening=0.25).opening == 0.25
    assert desk.run(1.0, **lost).opening == 0.25


def test_what_the_station_asks_no_more_is_not_said_any_more(desk):
    desk.run(0.1, opening=0.25)
    assert desk.run(0.1).opening is None


def test_the_newest_that_was_asked_counts(desk):
    desk.run(0.1, opening=0.0)
    assert desk.run(0.1, opening=1.0).opening == 1.0


def test_a_new_episode_begins_with_nothing_asked(desk):
    desk.run(0.1, opening=0.0)
    assert desk.run(0.1, robot=NEXT).opening is None


def test_where_no_episode_runs_nothing_is_asked(desk):
    desk.run(0.1, opening=0.0)
    idle = msgspec.structs.replace(REFINING, phase=Phase.IDLE)
    assert desk.run(0.1, opening=0.0, robot=idle).opening is None


def test_who_does_not_command_asks_for_nothing(desk):
    other = AuthorityState(holder="station-b", epoch=8, expires_in=1.0)
    assert desk.run(0.1, opening=0.0, authority=other).opening is None
