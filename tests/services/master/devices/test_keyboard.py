from dataclasses import FrozenInstanceError, fields

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.motion.rotations import conjugate, exp_map, log_map, multiply
from protocol.keys import PUSH_KEYS, TURN_KEYS
from protocol.messages import Mode, OperatorInput, Phase, Pose, RobotState
from services.master.devices.device import Moment
from services.master.devices.keyboard import LET_GO_S, KeyboardMaster, Law, directions, pushed
from services.process.config import Keyboard

KEYBOARD = Keyboard(growth=0.12, decay=0.05, reach=0.25, turn_growth=0.4, turn_decay=0.2, turn_reach=0.8)
LAW = Law(growth=0.12, decay=0.05, reach=0.25)
POSE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
REFINING = RobotState(measured=POSE, reference=POSE, phase=Phase.EXECUTE, mode=Mode.REFINE, episode=1)

Displacement = st.floats(-LAW.reach, LAW.reach)
Step = st.floats(0.0, 0.1)
Keys = st.sets(st.sampled_from([*PUSH_KEYS, *TURN_KEYS, "KeyZ", "Space"]))


def moment(*keys, dt=0.01, focused=True, robot=REFINING, commands=True):
    return Moment(0, dt, OperatorInput(keys=keys, focused=focused), robot, commands)


def hold(master, seconds, *keys, **others):
    sample = None
    for _ in range(round(seconds / 0.01)):
        sample = master.step(moment(*keys, **others))
    return sample


def seated():
    """A master whose operator sits there and holds nothing yet."""
    master = KeyboardMaster(KEYBOARD)
    for _ in range(2):
        master.step(moment())
    return master


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        ((), (0, 0, 0)),
        (("KeyQ",), (1, 0, 0)),
        (("KeyA",), (-1, 0, 0)),
        (("KeyW", "KeyE"), (0, 1, 1)),
        (("KeyS", "KeyD", "KeyQ"), (1, -1, -1)),
        (("KeyQ", "KeyA"), (0, 0, 0)),
        (("KeyQ", "KeyQ", "Space"), (1, 0, 0)),
    ],
)
def test_keys_push_along_their_axes_and_cancel_out(keys, expected):
    assert directions(keys, PUSH_KEYS) == expected
    assert directions(keys, TURN_KEYS) == (0, 0, 0)


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        (("KeyR",), (1, 0, 0)),
        (("KeyF",), (-1, 0, 0)),
        (("KeyT", "KeyY"), (0, 1, 1)),
        (("KeyG", "KeyH", "KeyR"), (1, -1, -1)),
        (("KeyT", "KeyG"), (0, 0, 0)),
    ],
)
def test_the_keys_beside_them_turn_about_the_same_axes(keys, expected):
    assert directions(keys, TURN_KEYS) == expected
    assert directions(keys, PUSH_KEYS) == (0, 0, 0)


@given(displacement=Displacement, direction=st.sampled_from([-1, 1]), dt=Step)
def test_a_held_key_grows_the_displacement_up_to_the_reach(displacement, direction, dt):
    after = pushed(displacement, direction, dt, LAW)
    assert abs(after) <= LAW.reach
    assert after * direction >= displacement * direction
    assert abs(after - displacement) <= LAW.growth * dt + 1e-12


@given(displacement=Displacement, dt=Step)
def test_without_a_key_it_decays_and_never_passes_zero(displacement, dt):
    after = pushed(displacement, 0, dt, LAW)
    assert after * displacement >= 0.0
    assert abs(after) == pytest.approx(max(0.0, abs(displacement) - LAW.decay * dt))


@given(displacement=Displacement, keys=Keys, first=Step, second=Step)
def test_the_speed_does_not_depend_on_how_often_it_is_asked(displacement, keys, first, second):
    for way in directions(keys, PUSH_KEYS):
        twice = pushed(pushed(displacement, way, first, LAW), way, second, LAW)
        assert twice == pytest.approx(pushed(displacement, way, first + second, LAW), abs=1e-12)


def test_a_law_does_not_change():
    for field in fields(LAW):
        with pytest.raises(FrozenInstanceError):
            setattr(LAW, field.name, 1.0)


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
    sample = KeyboardMaster(KEYBOARD).step(moment(robot=robot))
    assert sample.displacement == pytest.approx((0.1, -LAW.reach, 0.0))
    assert sample.velocity == (0.0, 0.0, 0.0)
    assert sample.rotation == pytest.approx((0.0, 0.3, -KEYBOARD.turn_reach))


def in_phase(phase, **changes):
    return msgspec.structs.replace(REFINING, phase=phase, **changes)


def test_whoever_engages_takes_over_what_the_robot_applies_whatever_its_gain():
    """A displacement times the gain is the correction: taken over without the gain it would jump."""
    robot = msgspec.structs.replace(REFINING, offset=(0.1, -0.05, 0.02), master_gain=0.5)
    sample = KeyboardMaster(KEYBOARD).step(moment(robot=robot))
    assert sample.displacement == pytest.approx((0.2, -0.1, 0.04))
    assert sample.velocity == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("phase", [Phase.RAMP, Phase.HOLD])
def test_keys_do_nothing_before_the_robot_executes(phase):
    master = seated()
    sample = hold(master, 1.0, "KeyQ", "KeyT", robot=in_phase(phase, offset=(0.0, 0.1, 0.0), turn=(0.0, 0.0, 0.2)))
    assert (sample.displacement, sample.rotation) == ((0.0, 0.1, 0.0), (0.0, 0.0, 0.2))
    assert sample.velocity == (0.0, 0.0, 0.0)
    assert sample.engaged


@pytest.mark.parametrize("phase", [Phase.RAMP, Phase.HOLD])
@pytest.mark.parametrize("key", ["KeyQ", "KeyT"])
def test_a_key_that_is_held_on_the_way_to_the_start_counts_only_once_all_were_let_go(phase, key):
    master = seated()
    hold(master, 0.5, key, robot=in_phase(phase))
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
    master = KeyboardMaster(KEYBOARD)
    assert not master.step(moment(robot=None)).engaged
    assert (master.name, master.figures()) == ("keyboard", ())


LED = RobotState(measured=POSE, reference=POSE, phase=Phase.EXECUTE, mode=Mode.TEACH, episode=1)


def leading():
    """A master whose operator leads the robot and holds nothing yet."""
    master = KeyboardMaster(KEYBOARD)
    for _ in range(2):
        master.step(moment(robot=LED))
    return master


def test_keys_that_lead_alone_leave_what_they_moved():
    master = leading()
    moved = hold(master, 1.0, "KeyQ", "KeyT", robot=LED)
    assert moved.displacement == pytest.approx((0.12, 0.0, 0.0))
    assert moved.rotation == pytest.approx((0.0, 0.4, 0.0))
    later = hold(master, 5.0, robot=LED)
    assert later.engaged
    assert (later.displacement, later.velocity) == (moved.displacement, (0.0, 0.0, 0.0))
    assert later.rotation == pytest.approx(moved.rotation)


def test_they_lead_as_far_as_they_are_held():
    assert hold(leading(), 5.0, "KeyD", robot=LED).displacement == pytest.approx((0.0, 0.0, -0.6))


def test_they_turn_about_the_base_axes_however_far_it_was_turned():
    master = leading()
    before = hold(master, 2.0, "KeyR", robot=LED).rotation
    after = hold(master, 0.1, "KeyY", robot=LED).rotation
    step = multiply(exp_map(np.array(after)), conjugate(exp_map(np.array(before))))
    np.testing.assert_allclose(log_map(step), (0.0, 0.0, 0.04), atol=1e-9)


def test_a_key_that_is_held_as_the_hand_takes_over_counts_once_all_were_let_go():
    master = KeyboardMaster(KEYBOARD)
    assert hold(master, 0.5, "KeyQ", robot=LED).displacement == (0.0, 0.0, 0.0)
    hold(master, 0.02, robot=LED)
    assert hold(master, 0.5, "KeyQ", robot=LED).displacement[0] == pytest.approx(0.06)


def test_without_the_focus_nobody_leads_and_what_was_moved_stands():
    master = leading()
    moved = hold(master, 0.5, "KeyQ", robot=LED)
    away = hold(master, 2.0, "KeyQ", robot=LED, focused=False)
    assert not away.engaged
    assert away.displacement == moved.displacement
    assert hold(master, 0.1, "KeyQ", robot=LED).displacement == moved.displacement, "held as the focus came back"


def test_keys_do_not_lead_while_the_robot_holds():
    master = leading()
    held = msgspec.structs.replace(LED, phase=Phase.HOLD)
    sample = hold(master, 1.0, "KeyQ", robot=held)
    assert sample.engaged
    assert sample.displacement == (0.0, 0.0, 0.0)


def test_after_it_the_device_is_back_at_rest_within_the_time_to_let_go():
    master = leading()
    hold(master, 10.0, "KeyQ", robot=LED)
    assert hold(master, LET_GO_S, robot=None).displacement == (0.0, 0.0, 0.0)
