"""A hand that leads the robot by the page's devices alone, without a prediction."""

import msgspec
import numpy as np
import pytest

from lfd.motion.rotations import conjugate, exp_map, log_map, multiply
from protocol.messages import Mode, Phase, RobotState
from services.master.devices.lever import LET_GO_S
from tests.services.master.devices.page_hand import (
    POSE,
    UP,
    hold,
    master,
    moment,
    pad,
    pointer,
)

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
