"""The force loop of a stylus: equation (14), a step a millisecond, a thread of its own."""

import pytest

from lfd import haptics
from services.master.devices.simulated_stylus import SimulatedStylus
from services.master.feedback import SOFT_START_S, STALE_S, Feedback
from services.master.haptics import HapticLoop, HapticThread
from services.process.clock import SystemClock
from sim.person.stylus import Stylus, StylusState

MS = 1_000_000


class NoHand:
    rotation = None

    def force(self, stylus):
        return (0.0, 0.0, 0.0)


def looped(stylus, stiffness, damping, start_ns=0):
    """A loop that nobody pushes against, and whose force is limited by nothing."""
    return HapticLoop(SimulatedStylus(stylus, NoHand()), Feedback(stiffness, damping, 1e3), start_ns)


def heard(loop, milliseconds, start_ns=0):
    """Let time pass in which the robot is heard."""
    for k in range(1, milliseconds + 1):
        loop.hear(start_ns + k * MS)
        rendered = loop.advance_to(start_ns + k * MS)
    return rendered


def test_a_loop_without_a_hand_returns_to_neutral():
    stylus = Stylus(state=StylusState(position=(0.1, 0.0, -0.1)))
    loop = looped(stylus, haptics.STIFFNESS, haptics.DAMPING, start_ns=0)
    rendered = heard(loop, 3000)
    assert rendered.stylus.position == pytest.approx((0.0, 0.0, 0.0), abs=1e-4)


def test_without_hearing_of_the_robot_there_is_no_force_within_a_tenth_of_a_second_and_it_rises_slowly_after():
    stylus = Stylus(mass=1e6, state=StylusState(position=(0.1, 0.0, -0.1)))
    loop = looped(stylus, 50.0, 2.0)
    whole = heard(loop, round(SOFT_START_S * 1e3) + 1)
    assert whole.feedback == pytest.approx((-5.0, 0.0, 5.0), rel=1e-3)
    start = round(SOFT_START_S * 1e3) + 1
    assert loop.advance_to((start + round(STALE_S * 1e3)) * MS).feedback == (0.0, 0.0, 0.0)
    again = heard(loop, 50, start_ns=(start + round(STALE_S * 1e3)) * MS)
    assert again.feedback == pytest.approx((-0.5, 0.0, 0.5), rel=0.05)


def test_a_loop_makes_one_step_a_millisecond_and_skips_a_long_gap():
    stylus = Stylus(damping=0.0, state=StylusState(velocity=(0.1, 0.0, 0.0)))
    loop = looped(stylus, 0.0, 0.0, start_ns=0)
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
    loop = looped(Stylus(), 50.0, 2.0, clock.now_ns())
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
