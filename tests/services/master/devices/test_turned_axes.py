"""A hand whose axes follow its operator's view: the same hand, turned; and nothing jumps."""

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocol.messages import Controller, Mode, OperatorInput, Phase, Pose, RobotState
from services.master.devices.controllers import Controllers
from services.master.devices.device import Moment
from services.master.devices.keys import Keys
from services.master.devices.led import LedMaster
from services.master.devices.pointer import Pad
from services.master.devices.profiles import Profiles
from services.process.master_devices import Page

LAW = Page(growth=0.12, decay=0.05, reach=0.25, turn_growth=0.4, turn_decay=0.2, turn_reach=0.8)
POSE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
REFINING = RobotState(measured=POSE, reference=POSE, phase=Phase.EXECUTE, mode=Mode.REFINE, episode=1)
LED = msgspec.structs.replace(REFINING, mode=Mode.TEACH)
DT = 0.01

Yaw = st.floats(-3.1, 3.1)
Keyed = st.lists(st.sampled_from(("KeyQ", "KeyA", "KeyW", "KeyS", "KeyE", "KeyR", "KeyY")), max_size=3)


class Operator:
    """At a master of everything that the page reads."""

    def __init__(self):
        profiles = Profiles()
        self.master = LedMaster(LAW, (Keys(), Controllers("gamepad", profiles), Pad(profiles)))

    def step(self, *keys, yaw=0.0, robot=REFINING, pads=(), focused=True):
        held = OperatorInput(keys=keys, focused=focused, controllers=tuple(pads), yaw=yaw)
        return self.master.step(Moment(0, DT, held, robot, commands=True))


def about_z(yaw):
    return np.array([[np.cos(yaw), -np.sin(yaw), 0.0], [np.sin(yaw), np.cos(yaw), 0.0], [0.0, 0.0, 1.0]])


@pytest.mark.parametrize("robot", [REFINING, LED], ids=["refining", "led"])
@given(yaw=Yaw, pressed=st.lists(Keyed, min_size=1, max_size=12))
def test_what_a_hand_does_in_turned_axes_is_what_it_does_in_the_robot_s_turned(robot, yaw, pressed):
    """Whatever is pressed and let go of, after one another: displacement, velocity and rotation turn with the view."""
    straight, turned = Operator(), Operator()
    for keys in ([], [], *pressed):
        for _ in range(8):
            one, other = straight.step(*keys, robot=robot), turned.step(*keys, robot=robot, yaw=yaw)
            for name in ("displacement", "velocity", "rotation"):
                expected = about_z(yaw) @ getattr(one, name)
                np.testing.assert_allclose(getattr(other, name), expected, atol=1e-9)
    assert other.yaw == pytest.approx(yaw)


@given(turns=st.lists(st.tuples(Yaw, Keyed), min_size=2, max_size=12))
def test_nothing_jumps_whenever_the_view_turns(turns):
    """Between two steps no axis goes farther than growth or decay take it."""
    operator = Operator()
    before = np.zeros(3)
    for yaw, keys in turns:
        for _ in range(30):
            now = np.array(operator.step(*keys, yaw=yaw).displacement)
            assert np.linalg.norm(now - before) <= np.sqrt(3.0) * LAW.growth * DT + 1e-9
            before = now


def test_axes_do_not_turn_while_anything_is_held():
    operator = Operator()
    for _ in range(2):
        operator.step()
    for _ in range(10):
        sample = operator.step("KeyQ", yaw=1.5)
    assert sample.yaw == 0.0
    assert sample.displacement == pytest.approx((10 * LAW.growth * DT, 0.0, 0.0))
    assert operator.step("KeyQ", "KeyE", yaw=0.5).yaw == 0.0
    assert operator.step(yaw=0.5).yaw == 0.5
    pointer = Controller("pointer", axes=(0.0,) * 6, buttons=(1.0,))
    assert operator.step(yaw=1.0, pads=(pointer,)).yaw == 0.5


def test_who_looks_elsewhere_turns_nothing():
    operator = Operator()
    operator.step(yaw=1.0)
    assert operator.step(yaw=0.0, focused=False).yaw == 1.0


@given(yaw=Yaw, first=Yaw, offset=st.tuples(*3 * [st.floats(-0.25, 0.25)]))
def test_whoever_takes_a_correction_over_goes_on_from_it_in_any_axes(yaw, first, offset):
    """Also from a corner of what can be reached, that is farther than any of the turned axes reaches."""
    held = msgspec.structs.replace(REFINING, phase=Phase.HOLD, offset=offset)
    operator = Operator()
    operator.step(yaw=first, robot=held)
    sample = operator.step(yaw=yaw, robot=held)
    np.testing.assert_allclose(sample.displacement, offset, atol=1e-12)
