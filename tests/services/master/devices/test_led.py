"""A hand that leads the robot by devices of the page: what counts, and when."""

import msgspec
import numpy as np
import pytest

from lfd.motion.rotations import conjugate, exp_map, log_map, multiply
from protocol.messages import Controller, Mode, OperatorInput, Phase, Pose, RobotState, Trouble
from services.master.devices.controllers import Controllers
from services.master.devices.device import Moment
from services.master.devices.keys import Keys
from services.master.devices.led import LedMaster
from services.master.devices.lever import LET_GO_S
from services.master.devices.pointer import Pad
from services.master.devices.profiles import Profiles
from services.process.master_devices import Page

LAW = Page(growth=0.12, decay=0.05, reach=0.25, turn_growth=0.4, turn_decay=0.2, turn_reach=0.8)
POSE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
REFINING = RobotState(measured=POSE, reference=POSE, phase=Phase.EXECUTE, mode=Mode.REFINE, episode=1)
REST = (0.0, 0.0, 0.0, 0.0)
UP = (0.0, 0.0, 0.0, -1.0)


def master():
    """As by default: whatever the page reads."""
    profiles = Profiles()
    return LedMaster(
        LAW, (Keys(), Controllers("gamepad", profiles), Controllers("spacemouse", profiles), Pad(profiles))
    )


def pad(axes=REST, number=0, **pressed):
    buttons = [0.0] * 17
    for name, value in pressed.items():
        buttons[int(name.removeprefix("b"))] = value
    return Controller("gamepad", number, "Some pad", True, axes, tuple(buttons))


def pointer(*axes, down=True):
    return Controller("pointer", axes=tuple(axes) + (0.0,) * (6 - len(axes)), buttons=(float(down),))


def moment(*keys, dt=0.01, focused=True, robot=REFINING, commands=True, pads=(), yaw=0.0):
    held = OperatorInput(keys=keys, focused=focused, controllers=tuple(pads), yaw=yaw)
    return Moment(0, dt, held, robot, commands)


def hold(master, seconds, *keys, **others):
    sample = None
    for _ in range(round(seconds / 0.01)):
        sample = master.step(moment(*keys, **others))
    return sample


def seated(*pads):
    """A master whose operator sits there and holds nothing yet."""
    one = master()
    for _ in range(2):
        one.step(moment(pads=pads))
    return one


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
    keyboard = master()
    assert not keyboard.step(moment(robot=None)).engaged
    assert (keyboard.name, keyboard.figures()) == ("keyboard", ())


def test_a_stick_pushes_as_far_as_it_is_deflected_and_names_itself():
    master = seated(pad())
    sample = hold(master, 0.5, pads=[pad(UP)])
    assert sample.displacement == pytest.approx((0.0, 0.0, 0.06))
    assert sample.velocity == pytest.approx((0.0, 0.0, 0.12))
    assert (sample.engaged, master.name) == (True, "gamepad")
    half = hold(seated(pad()), 0.5, pads=[pad((0.0, 0.0, 0.0, -0.56))])
    assert 0.0 < half.displacement[2] < 0.03


def test_a_stick_that_is_let_go_of_returns_as_keys_do():
    master = seated(pad())
    hold(master, 1.0, pads=[pad(UP)])
    assert hold(master, 1.0, pads=[pad()]).displacement == pytest.approx((0.0, 0.0, 0.07))


def test_bumpers_and_triggers_turn():
    sample = hold(seated(pad()), 0.5, pads=[pad(b5=1.0, b6=1.0)])
    assert sample.rotation == pytest.approx((0.2, -0.2, 0.0))


def test_two_devices_at_once_are_refused_until_one_is_let_go_of_and_the_other_was_at_rest():
    master = seated(pad())
    hold(master, 0.5, "KeyE", pads=[pad()])
    both = master.step(moment("KeyE", pads=[pad(UP)]))
    assert (both.engaged, both.trouble, both.trouble_with) == (False, Trouble.TWO, "gamepad and keyboard")
    assert not hold(master, 1.0, "KeyE", pads=[pad(UP)]).engaged
    one = hold(master, 0.5, "KeyE", pads=[pad()])
    assert (one.engaged, one.displacement) == (True, (0.0, 0.0, 0.0))
    assert (one.trouble, one.trouble_with) == (Trouble.NOT_AT_REST, "keyboard")
    hold(master, 0.02, pads=[pad()])
    assert hold(master, 0.5, "KeyE", pads=[pad()]).displacement == pytest.approx((0.0, 0.0, 0.06))


def test_two_pads_at_once_are_refused_and_one_after_the_other_is_not():
    master = seated(pad(), pad(number=1))
    assert hold(master, 0.5, pads=[pad(UP), pad(number=1)]).engaged
    hold(master, 0.1, pads=[pad(), pad(number=1)])
    assert hold(master, 0.5, pads=[pad(), pad(UP, number=1)]).engaged
    assert master.name == "gamepad 2"
    sample = master.step(moment(pads=[pad(UP), pad(UP, number=1)]))
    assert (sample.trouble, sample.trouble_with) == (Trouble.TWO, "gamepad and gamepad 2")


def test_a_pad_that_is_pulled_out_disengages_in_one_step_and_back_again_it_has_to_be_at_rest_first():
    master = seated(pad())
    before = hold(master, 0.5, pads=[pad(UP)])
    gone = master.step(moment())
    assert (gone.engaged, gone.trouble, gone.trouble_with) == (False, Trouble.GONE, "gamepad")
    assert gone.displacement[2] < before.displacement[2]
    assert not hold(master, 1.0).engaged
    held = msgspec.structs.replace(REFINING, offset=(0.0, 0.0, 0.06))
    back = hold(master, 0.5, pads=[pad(UP)], robot=held)
    assert (back.engaged, back.trouble) == (True, Trouble.NOT_AT_REST)
    assert back.displacement == pytest.approx((0.0, 0.0, 0.06), abs=0.026)
    hold(master, 0.02, pads=[pad()])
    assert hold(master, 0.5, pads=[pad(UP)]).displacement[2] > back.displacement[2]


def test_where_a_pad_was_pulled_out_the_keys_take_over_when_they_are_used():
    master = seated(pad())
    hold(master, 0.5, pads=[pad(UP)])
    assert not hold(master, 0.5).engaged
    master.step(moment("KeyQ"))
    assert (hold(master, 0.1).engaged, master.name) == (True, "keyboard")


def test_a_device_that_was_taken_away_between_two_episodes_is_not_missed():
    master = seated(pad())
    hold(master, 0.5, pads=[pad(UP)])
    idle = msgspec.structs.replace(REFINING, phase=Phase.IDLE)
    hold(master, 0.02, pads=[pad()], robot=idle)
    sample = hold(master, 0.02, robot=idle)
    assert (sample.trouble, master.name) == (Trouble.NONE, "keyboard")
    assert hold(master, 0.02).engaged


def test_a_stick_that_drifts_asks_for_nothing_and_leaves_the_keys_alone():
    drifting = pad((0.3, 0.0, 0.0, 0.0))
    master = seated(drifting)
    sample = hold(master, 0.5, "KeyE", pads=[drifting])
    assert sample.displacement == pytest.approx((0.0, 0.0, 0.06))
    assert (sample.trouble, sample.trouble_with) == (Trouble.NOT_AT_REST, "gamepad")


def test_within_the_dead_zone_a_stick_does_not_lead():
    sample = hold(seated(pad()), 1.0, pads=[pad((0.11, -0.11, 0.11, -0.11))])
    assert (sample.displacement, sample.rotation) == ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def test_a_trigger_that_rests_at_minus_one_leads_nowhere():
    """Without a standard order nothing but the first stick is believed."""

    def odd(*axes):
        return Controller("gamepad", 0, "Generic USB", False, axes, (0.0,) * 10)

    rest = (0.0, 0.0, -1.0, 0.0, 0.0, -1.0)
    master = seated(odd(*rest))
    assert hold(master, 1.0, pads=[odd(*rest)]).displacement == (0.0, 0.0, 0.0)
    assert hold(master, 0.5, pads=[odd(0.0, -1.0, -1.0, 0.0, 0.0, -1.0)]).displacement == pytest.approx((0.06, 0, 0))


def test_a_drag_leads_by_its_distance_and_stays_while_it_is_held():
    master = seated(pointer(5.0, 5.0, down=False))
    hold(master, 0.02, pads=[pointer(5.0, 5.0)])
    sample = hold(master, 0.01, pads=[pointer(4.8, 4.6, -0.1)])
    assert sample.displacement == pytest.approx((0.025, 0.05, 0.1))
    assert hold(master, 2.0, pads=[pointer(4.8, 4.6, -0.1)]).displacement == pytest.approx((0.025, 0.05, 0.1))
    assert (sample.engaged, master.name) == (True, "pointer")


def test_a_pen_that_is_lifted_lets_the_correction_return_and_put_down_elsewhere_it_does_not_jump():
    master = seated(pointer(down=False))
    hold(master, 0.02, pads=[pointer()])
    hold(master, 0.02, pads=[pointer(0.0, -0.4)])
    lifted = hold(master, 1.0, pads=[pointer(0.0, -0.4, down=False)])
    assert lifted.displacement == pytest.approx((0.0, 0.0, 0.05))
    again = hold(master, 0.02, pads=[pointer(0.7, 0.9)])
    assert again.displacement == pytest.approx((0.0, 0.0, 0.05), abs=0.001)


def test_what_is_dragged_while_the_page_has_not_the_focus_counts_for_nothing():
    master = seated(pointer(down=False))
    hold(master, 0.02, pads=[pointer()])
    hold(master, 0.5, pads=[pointer(0.5)], focused=False)
    hold(master, 0.02, pads=[pointer(0.6, down=False)])
    assert hold(master, 0.02, pads=[pointer(0.6)]).displacement == (0.0, 0.0, 0.0)


def test_buttons_say_actions_while_they_are_held():
    master = seated(pad())
    assert master.step(moment(pads=[pad(b0=1.0, b2=0.6)])).actions == ("finish", "store")
    assert master.step(moment(pads=[pad(b0=0.4)])).actions == ()
    assert master.step(moment(pads=[pad(b0=1.0)], focused=False)).actions == ()


def test_a_gamepad_that_is_configured_and_not_there_is_said_to_be_absent():
    master = LedMaster(LAW, (Controllers("gamepad", Profiles()),))
    sample = master.step(moment("KeyQ"))
    assert (sample.engaged, sample.trouble, sample.trouble_with) == (False, Trouble.ABSENT, "gamepad")
    hold(master, 0.02, pads=[pad(number=1)])
    assert hold(master, 0.5, pads=[pad(UP, number=1)]).displacement == pytest.approx((0.0, 0.0, 0.06))


LED = RobotState(measured=POSE, reference=POSE, phase=Phase.EXECUTE, mode=Mode.TEACH, episode=1)


def leading():
    """A master whose operator leads the robot and holds nothing yet."""
    one = master()
    for _ in range(2):
        one.step(moment(robot=LED))
    return one


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
    one = master()
    assert hold(one, 0.5, "KeyQ", robot=LED).displacement == (0.0, 0.0, 0.0)
    hold(one, 0.02, robot=LED)
    assert hold(one, 0.5, "KeyQ", robot=LED).displacement[0] == pytest.approx(0.06)


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


def test_a_pen_that_leads_alone_decouples_where_it_is_lifted_and_goes_on_from_there():
    one = leading()
    hold(one, 0.02, pads=[pointer(down=False)], robot=LED)
    hold(one, 0.02, pads=[pointer()], robot=LED)
    moved = hold(one, 0.02, pads=[pointer(-0.4, 0.0, 0.0, 0.5)], robot=LED)
    assert moved.engaged
    assert moved.displacement == pytest.approx((0.0, 0.1, 0.0))
    assert moved.rotation == pytest.approx((0.0, 0.0, -0.4))
    lifted = hold(one, 1.0, pads=[pointer(-0.4, 0.0, 0.0, 0.5, down=False)], robot=LED)
    assert (lifted.engaged, lifted.displacement) == (False, moved.displacement)
    hold(one, 0.02, pads=[pointer(-0.4, 0.0, 0.0, 0.5)], robot=LED)
    again = hold(one, 0.02, pads=[pointer(-5.4, 0.0, 0.0, 0.5)], robot=LED)
    assert again.displacement == pytest.approx((0.0, 1.35, 0.0))


def test_a_stick_that_leads_alone_leaves_what_it_moved():
    one = leading()
    hold(one, 0.02, pads=[pad()], robot=LED)
    moved = hold(one, 1.0, pads=[pad(UP)], robot=LED)
    assert moved.displacement == pytest.approx((0.0, 0.0, 0.12), abs=0.002)
    assert hold(one, 2.0, pads=[pad()], robot=LED).displacement == moved.displacement
