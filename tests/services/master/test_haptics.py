"""The force loop of the simulated stylus: equation (14), a step a millisecond, a thread of its own."""

import pytest

from lfd import haptics
from services.master.haptics import HapticLoop, HapticThread
from services.process.clock import SystemClock
from sim.person.stylus import Stylus, StylusState


class NoHand:
    rotation = None

    def force(self, stylus):
        return (0.0, 0.0, 0.0)


def test_a_loop_without_a_hand_returns_to_neutral():
    stylus = Stylus(state=StylusState(position=(0.1, 0.0, -0.1)))
    loop = HapticLoop(stylus, NoHand(), haptics.STIFFNESS, haptics.DAMPING, start_ns=0)
    for _ in range(3000):
        rendered = loop.step(1e-3)
    assert rendered.stylus.position == pytest.approx((0.0, 0.0, 0.0), abs=1e-4)


def test_the_feedback_is_equation_14():
    stylus = Stylus(state=StylusState(position=(0.1, 0.0, -0.1), velocity=(0.0, 0.5, 0.0)))
    loop = HapticLoop(stylus, NoHand(), 50.0, 2.0, start_ns=0)
    assert loop.newest.feedback == pytest.approx((-5.0, -1.0, 5.0))


def test_a_loop_makes_one_step_a_millisecond_and_skips_a_long_gap():
    stylus = Stylus(damping=0.0, state=StylusState(velocity=(0.1, 0.0, 0.0)))
    loop = HapticLoop(stylus, NoHand(), 0.0, 0.0, start_ns=0)
    loop.advance_to(10_400_000)
    assert stylus.state.position[0] == pytest.approx(0.001)
    loop.advance_to(10_900_000)
    assert stylus.state.position[0] == pytest.approx(0.001)
    loop.advance_to(11_000_000)
    assert stylus.state.position[0] == pytest.approx(0.0011)
    loop.advance_to(60_000_000_000)
    assert stylus.state.position[0] == pytest.approx(0.0111)


def test_a_thread_keeps_the_loop_going_and_stops():
    clock = SystemClock()
    loop = HapticLoop(Stylus(), NoHand(), 50.0, 2.0, clock.now_ns())
    thread = HapticThread(loop, clock)
    deadline = clock.now_ns() + 5_000_000_000
    ticks = 0.0
    while ticks < 50 and clock.now_ns() < deadline:
        clock.sleep_until(clock.now_ns() + 10_000_000, stop=None)
        ticks = {figure.name: figure.value for figure in thread.figures()}["haptic_ticks"]
    thread.close()
    after = {figure.name: figure.value for figure in thread.figures()}["haptic_ticks"]
    clock.sleep_until(clock.now_ns() + 10_000_000, stop=None)
    assert after >= 50
    assert {figure.name: figure.value for figure in thread.figures()}["haptic_ticks"] == after
