"""Pads, sticks and pointers of the page that lead the robot: what counts, and which of several."""

import msgspec
import pytest

from protocol.messages import Controller, Phase, Trouble
from services.master.devices.controllers import Controllers
from services.master.devices.led import LedMaster
from services.master.devices.profiles import Profiles
from tests.services.master.devices.page_hand import (
    LAW,
    REFINING,
    UP,
    hold,
    moment,
    pad,
    pointer,
    seated,
)


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
