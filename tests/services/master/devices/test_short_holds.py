"""A hold that ends by itself costs nobody their correction; after any other everything is let go of first."""

import msgspec
import numpy as np
import pytest

from protocol.messages import Mode, Phase
from services.master.devices.device import Moment
from tests.services.master.devices.page_hand import LAW, REFINING, UP, hold, master, moment, pad, pointer, seated

HELD = msgspec.structs.replace(REFINING, phase=Phase.HOLD, offset=(0.04, 0.0, 0.0))
AGAIN = msgspec.structs.replace(REFINING, offset=(0.04, 0.0, 0.0))
LATE = {"late": True, "focused": False}
UNHEARD = object()
STEP = LAW.growth * 0.01


def interrupted(one, interruption, *keys, **others):
    """A quarter of a second in which the robot holds."""
    if interruption is UNHEARD:
        for _ in range(25):
            one.step(Moment(0, 0.01, None, None, commands=False))
        return None
    keys = () if interruption is LATE else keys
    return hold(one, 0.25, *keys, **({"robot": HELD} | interruption | others))


@pytest.mark.parametrize("interruption", [{}, LATE, UNHEARD], ids=["the robot's", "the page's", "everybody's"])
def test_a_key_that_was_down_all_through_a_short_hold_leads_on_from_what_is_applied_without_a_jump(interruption):
    one = seated()
    hold(one, 0.5, "KeyQ")
    interrupted(one, interruption, "KeyQ")
    before = np.array(one.step(moment("KeyQ", robot=HELD)).displacement)
    assert before == pytest.approx(HELD.offset)
    for _ in range(25):
        sample = one.step(moment("KeyQ", robot=AGAIN))
        now = np.array(sample.displacement)
        assert sample.engaged
        assert np.linalg.norm(now - before) <= STEP + 1e-9
        before = now
    assert before == pytest.approx((0.04 + 25 * STEP, 0.0, 0.0))


def test_a_pad_and_a_pen_lead_on_as_a_key_does():
    for held, still in ((pad(UP), pad()), (pointer(0.0, -0.4), pointer(down=False))):
        one = seated(still)
        hold(one, 0.5, pads=[held])
        interrupted(one, {}, pads=[held])
        one.step(moment(pads=[held], robot=AGAIN))
        dragged = held if held.kind == "gamepad" else pointer(0.0, -0.6)
        assert one.step(moment(pads=[dragged], robot=AGAIN)).displacement != pytest.approx(AGAIN.offset)


def test_what_is_held_does_nothing_while_the_robot_holds():
    one = seated()
    hold(one, 0.5, "KeyQ")
    assert interrupted(one, {}, "KeyQ").displacement == HELD.offset


@pytest.mark.parametrize(
    "interruption",
    [
        {"focused": False},
        {"commands": False},
        {"robot": msgspec.structs.replace(HELD, waiting=True)},
        {"robot": msgspec.structs.replace(HELD, phase=Phase.STOPPED)},
        {"robot": msgspec.structs.replace(HELD, phase=Phase.RAMP)},
        {"robot": msgspec.structs.replace(HELD, phase=Phase.IDLE)},
        {"robot": msgspec.structs.replace(HELD, mode=Mode.AUTONOMOUS)},
        LATE | {"robot": msgspec.structs.replace(HELD, waiting=True)},
        LATE | {"robot": msgspec.structs.replace(HELD, episode=2)},
        LATE | {"robot": msgspec.structs.replace(HELD, publisher=7)},
        {"robot": None, "focused": False},
    ],
)
def test_after_any_other_interruption_a_held_key_counts_once_all_were_let_go(interruption):
    one = seated()
    hold(one, 0.5, "KeyQ")
    hold(one, 0.02, *(() if interruption.get("late") else ("KeyQ",)), **interruption)
    hold(one, 0.02, "KeyQ", robot=HELD)
    assert hold(one, 0.25, "KeyQ", robot=AGAIN).displacement[0] < AGAIN.offset[0], "it fades, as if nothing were held"
    hold(one, 0.01, robot=AGAIN)
    assert hold(one, 0.25, "KeyQ", robot=AGAIN).displacement[0] > AGAIN.offset[0]


def test_where_the_hand_leads_alone_it_leads_on_as_well():
    led, held = (msgspec.structs.replace(REFINING, mode=Mode.TEACH, phase=p) for p in (Phase.EXECUTE, Phase.HOLD))
    one = master()
    hold(one, 0.02, robot=led)
    before = hold(one, 0.5, "KeyQ", robot=led).displacement[0]
    assert hold(one, 0.25, "KeyQ", robot=held).displacement[0] == pytest.approx(before)
    assert hold(one, 0.25, "KeyQ", robot=led).displacement[0] == pytest.approx(before + 25 * STEP)
