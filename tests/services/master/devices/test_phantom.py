"""A Phantom Omni or Touch, against a stand-in for the vendor's interface."""

import importlib

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.motion.rotations import exp_map, matrix_from_quaternion
from protocol.messages import OperatorInput, Phase
from services.master.devices import phantom
from services.master.devices.device import Moment
from services.master.devices.phantom import TO_BASE, PhantomStylus
from services.master.feedback import SOFT_START_S, STALE_S
from services.process.exceptions import DeviceMissing, RoomMissing
from tests.services.master.devices.phantom_desk import LED, REFINING, Desk, FakeDriver


def test_without_a_device_it_is_said_what_to_do():
    with pytest.raises(DeviceMissing, match=r"there is no phantom at this computer.*plug it in"):
        PhantomStylus(FakeDriver(there=False))


def test_without_the_vendors_modules_the_extra_is_named(monkeypatch):
    def missing(name):
        raise OSError("libHD.so: cannot open shared object file")

    monkeypatch.setattr(importlib, "import_module", missing)
    with pytest.raises(RoomMissing, match=r"'pyOpenHaptics': install retouch\[phantom\]"):
        phantom.vendor()


def test_what_the_vendor_has_in_two_modules_is_served_as_one(monkeypatch):
    calls = []

    class Module:
        def __getattr__(self, name):
            return lambda *values: calls.append((name, *values)) or name

    monkeypatch.setattr(importlib, "import_module", lambda name: Module())
    interface = phantom.vendor()
    interface.serve(print)
    interface.stop(7)
    assert calls == [
        ("hd_callback", print),
        ("start_scheduler",),
        ("hdAsyncSheduler", "hd_callback"),
        ("stop_scheduler",),
        ("close_device", 7),
    ]


@pytest.mark.parametrize(
    ("device", "base"), [((10.0, 0, 0), (0, -0.01, 0)), ((0, 10.0, 0), (0, 0, 0.01)), ((0, 0, 10.0), (-0.01, 0, 0))]
)
def test_it_counts_right_up_and_towards_the_hand_in_millimetres(device, base):
    driver = FakeDriver()
    stylus = PhantomStylus(driver)
    driver.place = np.array(device)
    assert stylus.exchange((0.0, 0.0, 0.0), 1e-3).position == pytest.approx(base)


@given(force=st.tuples(*[st.floats(-3.0, 3.0)] * 3))
def test_a_force_in_base_axes_is_the_same_force_in_the_devices(force):
    driver = FakeDriver()
    PhantomStylus(driver).exchange(force, 1e-3)
    assert TO_BASE @ np.array(driver.force) == pytest.approx(force)


@given(turn=st.tuples(*[st.floats(-1.7, 1.7)] * 3))
def test_a_turn_of_the_handle_is_a_rotation_vector_in_base_axes_since_it_was_taken_up(turn):
    driver = FakeDriver()
    stylus = PhantomStylus(driver)
    driver.turned = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    stylus.exchange((0.0, 0.0, 0.0), 1e-3)
    stylus.take_up((0.0, 0.0, 0.0))
    in_base = matrix_from_quaternion(exp_map(np.array(turn)))
    driver.turned = TO_BASE.T @ in_base @ TO_BASE @ driver.turned
    stylus.exchange((0.0, 0.0, 0.0), 1e-3)
    assert stylus.rotation() == pytest.approx(turn, abs=1e-9)


def test_the_velocity_is_that_of_the_position_after_a_moment_and_begins_at_nothing():
    driver = FakeDriver()
    driver.place = np.array([50.0, 0.0, 0.0])
    stylus = PhantomStylus(driver)
    assert stylus.exchange((0.0, 0.0, 0.0), 1e-3).velocity == (0.0, 0.0, 0.0)
    for _ in range(100):
        driver.place = driver.place + np.array([0.0, 0.1, 0.0])
        state = stylus.exchange((0.0, 0.0, 0.0), 1e-3)
    assert state.velocity == pytest.approx((0.0, 0.0, 0.1), rel=1e-3)


def test_a_hand_that_takes_it_up_goes_on_from_what_the_robot_applies_wherever_it_is():
    desk = Desk()
    desk.move(0.1, -0.05, 0.2)
    robot = msgspec.structs.replace(REFINING, offset=(0.02, 0.0, -0.01), turn=(0.0, 0.1, 0.0), master_gain=0.5)
    sample = desk.run(0.02, robot)
    assert sample.engaged
    assert sample.displacement == pytest.approx((0.04, 0.0, -0.02))
    assert sample.rotation == pytest.approx((0.0, 0.1, 0.0))
    desk.move(0.01, 0.0, 0.0)
    assert desk.run(0.02, robot).displacement == pytest.approx((0.05, 0.0, -0.02))


def test_the_hand_counts_only_while_it_holds_the_clutch_and_somebody_is_present():
    desk = Desk()
    assert desk.run(0.1).engaged
    assert not desk.run(0.01, held=False).engaged
    assert not desk.run(0.1, present=False).engaged
    assert not desk.run(0.1, robot=None).engaged


def test_it_feels_equation_14_within_the_limit():
    desk = Desk(force_limit=1.5)
    desk.run(0.02)
    desk.move(0.02, 0.0, 0.0)
    felt = desk.run(SOFT_START_S + 0.2)
    assert felt.force == pytest.approx((-1.0, 0.0, 0.0), abs=1e-3)
    desk.move(0.08, 0.0, 0.0)
    desk.run(0.5)
    assert TO_BASE @ np.array(desk.driver.force) == pytest.approx((-1.5, 0.0, 0.0), abs=1e-3)


def test_it_feels_what_the_robot_touches_within_the_limit_and_tells_what_the_hand_puts_in_against_it():
    desk = Desk(stiffness=1e-6, damping=1e-6, force_limit=1.5)
    touching = msgspec.structs.replace(REFINING, contact_force=(-1.0, 0.0, 0.0))
    felt = desk.run(SOFT_START_S + 0.2, touching)
    assert felt.force == pytest.approx((-1.0, 0.0, 0.0), abs=1e-3)
    assert felt.contact_energy == 0.0
    for _ in range(10):
        desk.move(0.001, 0.0, 0.0)
        felt = desk.run(0.01, touching)
    assert felt.contact_energy == pytest.approx(0.01, rel=0.1)
    harder = desk.run(0.2, msgspec.structs.replace(touching, contact_force=(-20.0, 0.0, 0.0)))
    assert harder.force == pytest.approx((-1.5, 0.0, 0.0), abs=1e-3)


@pytest.mark.parametrize(
    "ends",
    [
        {"robot": None},
        {"held": False},
        {"present": False},
        {"robot": msgspec.structs.replace(REFINING, phase=Phase.HOLD)},
    ],
)
def test_the_force_is_zero_a_tenth_of_a_second_after_nothing_is_refined_any_more(ends):
    desk = Desk()
    desk.run(0.02)
    desk.move(0.02, 0.0, 0.0)
    desk.run(1.0)
    assert desk.driver.force != (0.0, 0.0, 0.0)
    desk.run(STALE_S + 0.01, **ends)
    assert desk.driver.force == pytest.approx((0.0, 0.0, 0.0))


def test_the_force_is_zero_a_tenth_of_a_second_after_the_process_stopped_stepping():
    desk = Desk()
    desk.run(0.02)
    desk.move(0.02, 0.0, 0.0)
    desk.run(1.0)
    for _ in range(round(STALE_S * 1e3) + 1):
        desk.clock.advance(1e-3)
        desk.driver.body()
    assert desk.driver.force == pytest.approx((0.0, 0.0, 0.0))


def test_a_hand_that_leads_alone_feels_nothing_and_is_coupled_and_decoupled_without_a_jump():
    desk = Desk()
    desk.run(0.02, LED)
    desk.move(0.3, 0.0, 0.0)
    moved = desk.run(1.0, LED)
    assert moved.displacement == pytest.approx((0.3, 0.0, 0.0))
    assert desk.driver.force == pytest.approx((0.0, 0.0, 0.0))
    apart = desk.run(0.02, LED, held=False)
    assert not apart.engaged
    desk.move(-0.3, 0.1, 0.0)
    assert desk.run(0.02, LED).displacement == pytest.approx((0.3, 0.0, 0.0))
    desk.move(0.0, 0.0, 0.05)
    assert desk.run(0.02, LED).displacement == pytest.approx((0.3, 0.0, 0.05))


def test_its_second_button_stores_a_waypoint_and_closed_it_is_let_go_of():
    desk = Desk()
    desk.driver.buttons = 2
    desk.driver.body()
    sample = desk.master.step(Moment(0, 0.01, OperatorInput(present=True), None, commands=True))
    assert sample.actions == ("store",)
    assert {figure.name for figure in desk.master.figures()} >= {"haptic_period_p99", "haptic_ticks"}
    desk.master.close()
    assert desk.driver.stopped == 7
