"""Keys of the page that lead the robot: what counts, and when."""

import msgspec
import pytest

from protocol.messages import Mode, Phase
from services.master.devices.device import Moment
from tests.services.master.devices.page_hand import (
    REFINING,
    hold,
    master,
    moment,
    seated,
)


def test_diagonals_move_both_axes_at_full_growth():
    sample = hold(seated(), 0.5, "KeyQ", "KeyD")
    assert sample.displacement == pytest.approx((0.06, 0.0, -0.06))
    assert sample.velocity == pytest.approx((0.12, 0.0, -0.12))
    assert sample.engaged


def test_turning_has_its_own_law_and_moves_nothing():
    master = seated()
    sample = hold(master, 0.5, "KeyR", "KeyH")
    assert sample.rotation == pytest.approx((0.2, 0.0, -0.2))
    assert (sample.displacement, sample.velocity) == ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    assert hold(master, 10.0, "KeyR", "KeyH").rotation == pytest.approx((0.8, 0.0, -0.8))
    assert hold(master, 1.0).rotation == pytest.approx((0.6, 0.0, -0.6))
    assert hold(master, 3.1).rotation == (0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    "loss",
    [
        {"focused": False},
        {"robot": None},
        {"robot": msgspec.structs.replace(REFINING, mode=Mode.AUTONOMOUS)},
        {"robot": msgspec.structs.replace(REFINING, phase=Phase.STOPPED)},
        {"commands": False},
    ],
)
def test_whatever_is_lost_disengages_at_once_and_returns_to_zero_although_keys_are_held(loss):
    master = seated()
    before = hold(master, 3.0, "KeyQ", "KeyS", "KeyT")
    assert before.displacement == pytest.approx((0.25, -0.25, 0.0))
    assert before.rotation == pytest.approx((0.0, 0.8, 0.0))
    first = master.step(moment("KeyQ", "KeyS", "KeyT", **loss))
    assert not first.engaged
    assert abs(first.displacement[0]) < abs(before.displacement[0])
    assert abs(first.rotation[1]) < abs(before.rotation[1])
    half = hold(master, 0.09, "KeyQ", "KeyS", "KeyT", **loss)
    assert half.displacement == pytest.approx((0.125, -0.125, 0.0))
    assert half.rotation == pytest.approx((0.0, 0.4, 0.0))
    last = hold(master, 0.1, "KeyQ", "KeyS", "KeyT", **loss)
    assert (last.displacement, last.rotation) == ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def test_a_page_that_went_silent_holds_no_key():
    master = seated()
    hold(master, 1.0, "KeyQ")
    assert not master.step(Moment(0, 0.01, None, REFINING, commands=True)).engaged


def test_whoever_engages_takes_over_the_correction_that_the_robot_applies():
    robot = msgspec.structs.replace(REFINING, offset=(0.1, -0.4, 0.0), turn=(0.0, 0.3, -0.9))
    sample = master().step(moment(robot=robot))
    assert sample.displacement == robot.offset
    assert sample.velocity == (0.0, 0.0, 0.0)
    assert sample.rotation == robot.turn


def in_phase(phase, **changes):
    return msgspec.structs.replace(REFINING, phase=phase, **changes)


def test_whoever_engages_takes_over_what_the_robot_applies_whatever_its_gain():
    """A displacement times the gain is the correction: taken over without the gain it would jump."""
    robot = msgspec.structs.replace(REFINING, offset=(0.1, -0.05, 0.02), master_gain=0.5)
    sample = master().step(moment(robot=robot))
    assert sample.displacement == pytest.approx((0.2, -0.1, 0.04))
    assert sample.velocity == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("phase", [Phase.RAMP, Phase.HOLD])
def test_keys_do_nothing_before_the_robot_executes(phase):
    master = seated()
    sample = hold(master, 1.0, "KeyQ", "KeyT", robot=in_phase(phase, offset=(0.0, 0.1, 0.0), turn=(0.0, 0.0, 0.2)))
    assert (sample.displacement, sample.rotation) == ((0.0, 0.1, 0.0), (0.0, 0.0, 0.2))
    assert sample.velocity == (0.0, 0.0, 0.0)
    assert sample.engaged


@pytest.mark.parametrize("before", [in_phase(Phase.RAMP), in_phase(Phase.HOLD, waiting=True)])
@pytest.mark.parametrize("key", ["KeyQ", "KeyT"])
def test_a_key_that_is_held_on_the_way_to_the_start_or_asked_for_counts_only_once_all_were_let_go(before, key):
    master = seated()
    hold(master, 0.5, key, robot=before)
    still = hold(master, 1.0, key)
    assert (still.displacement, still.rotation) == ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    assert still.engaged
    hold(master, 0.01, "Space")
    moved = hold(master, 1.0, key)
    assert (moved.displacement, moved.rotation) != ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


@pytest.mark.parametrize("phase", [Phase.RAMP, Phase.HOLD])
def test_a_key_that_is_pressed_just_when_the_robot_executes_counts(phase):
    master = seated()
    hold(master, 0.5, "KeyQ", robot=in_phase(phase))
    hold(master, 0.01, robot=in_phase(phase))
    assert hold(master, 0.5, "KeyQ").displacement == pytest.approx((0.06, 0.0, 0.0))


def test_after_an_absence_a_held_key_counts_once_all_were_let_go():
    master = seated()
    hold(master, 0.5, "KeyQ", focused=False)
    assert hold(master, 0.5, "KeyQ").displacement == (0.0, 0.0, 0.0)


def test_the_velocity_is_that_of_the_displacement_and_none_where_no_time_passes():
    master = seated()
    hold(master, 0.5, "KeyQ", "KeyS", "KeyE")
    assert master.step(moment("KeyQ", "KeyS", "KeyE", dt=0.05)).velocity == pytest.approx((0.12, -0.12, 0.12))
    assert master.step(moment("KeyQ", "KeyS", "KeyE", dt=0.0)).velocity == (0.0, 0.0, 0.0)


def test_a_master_that_nobody_has_touched_is_not_engaged_and_names_itself():
    keyboard = master()
    assert not keyboard.step(moment(robot=None)).engaged
    assert (keyboard.name, keyboard.figures()) == ("keyboard", ())
