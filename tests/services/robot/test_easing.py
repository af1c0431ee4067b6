"""How a motion comes to rest where its operator is not heard for a moment, and how it goes on: never with a jolt."""

import numpy as np
import pytest

from protocol import queries
from protocol.messages import Mode, Phase
from services.robot.clutch import FADE
from services.robot.easing import EASE_S
from services.robot.safety import SLOWING_S
from tests.services.robot.site import Site, straight

PERIOD = 0.01
SPEED = 0.1  # [m/s] of the motion
STEEPEST = 1.5
"""Of a speed that is a cubic in time: its slope at most, beside its mean one."""

BRAKING = STEEPEST * SPEED / SLOWING_S
STARTING = STEEPEST * SPEED / EASE_S
NEUTRAL = (0.0, 0.0, 0.0)


class Led:
    """A motion at an even speed, well under way; every control period of it is seen."""

    def __init__(self, mode=Mode.REFINE):
        self.site = Site()
        self.site.acquire()
        self.site.execute(mode, straight(duration=4.0, length=SPEED * 4.0, n=80))
        self.seen = []
        self.run(1.2, master=NEUTRAL)
        assert self.site.state.phase is Phase.EXECUTE

    def run(self, seconds, **said):
        for _ in range(round(seconds / PERIOD)):
            self.site.run(PERIOD, **said)
            self.seen.append(self.site.state)

    def cut(self, seconds):
        """Neither the hand nor its operator is heard."""
        self.run(seconds, renew=False)

    def since(self, index):
        """The references from a period on, shape (n, 3)."""
        return np.array([state.reference.position for state in self.seen[index:]])


def accelerations(references):
    return np.linalg.norm(np.diff(references, 2, axis=0), axis=1) / PERIOD**2


def speeds(references):
    return np.linalg.norm(np.diff(references, axis=0), axis=1) / PERIOD


@pytest.mark.parametrize("seconds", [0.3, 0.5, 2.0])
def test_a_motion_that_is_not_heard_of_slows_down_and_stands_when_it_holds(seconds):
    led = Led()
    cut = len(led.seen)
    led.cut(seconds)
    assert accelerations(led.since(cut - 5)).max() <= 1.1 * BRAKING
    held = next(index for index, state in enumerate(led.seen) if index > cut and state.phase is Phase.HOLD)
    assert (held - cut + 1) * PERIOD <= 0.11 + 1e-9
    assert speeds(led.since(held - 1)).max() <= 1e-9


def test_without_its_operator_a_motion_alone_slows_down_and_stands_when_it_holds():
    led = Led(Mode.AUTONOMOUS)
    cut = len(led.seen)
    led.cut(0.3)
    assert accelerations(led.since(cut - 5)).max() <= 1.1 * BRAKING
    held = next(index for index, state in enumerate(led.seen) if index > cut and state.phase is Phase.HOLD)
    assert (held - cut + 1) * PERIOD <= 0.21 + 1e-9


@pytest.mark.parametrize("seconds", [0.12, 0.3, 0.55])
def test_after_a_short_hold_a_motion_goes_on_from_rest(seconds):
    led = Led()
    led.cut(seconds)
    index = len(led.seen)
    led.run(1.0, master=NEUTRAL)
    assert accelerations(led.since(index - 2)).max() <= 1.1 * STARTING
    assert speeds(led.since(index))[-1] == pytest.approx(SPEED)


def test_after_a_long_hold_it_goes_on_from_rest_where_the_ramp_ends():
    led = Led()
    led.cut(1.0)
    led.run(0.1, master=NEUTRAL)
    assert led.site.state.waiting
    led.site.ask(queries.RESUME, queries.Resume(led.site.epoch))
    index = len(led.seen)
    led.run(1.2, master=NEUTRAL)
    assert accelerations(led.since(index - 2)).max() <= 1.1 * STARTING
    assert speeds(led.since(index))[-1] == pytest.approx(SPEED)


def test_what_the_hand_did_in_a_short_hold_is_not_caught_up_with_at_once():
    led = Led()
    led.run(0.5, master=(0.0, 0.02, 0.0))
    led.cut(0.3)
    index = len(led.seen)
    led.run(2.0, master=(0.0, 0.08, 0.0))
    offsets = np.array([state.offset for state in led.seen[index - 1 :]])
    assert speeds(offsets).max() <= 1.01 * FADE
    assert offsets[-1][1] == pytest.approx(0.08, abs=1e-3)


def test_a_hand_that_moved_when_it_was_heard_last_leaves_no_jolt():
    led = Led()
    for tick in range(30):
        led.run(PERIOD, master=(0.0, 0.001 * tick, 0.0))
    cut = len(led.seen)
    led.cut(0.3)
    speed = np.hypot(SPEED, 0.1)
    assert accelerations(led.since(cut)).max() <= 1.1 * STEEPEST * speed / SLOWING_S


@pytest.mark.parametrize("silence", [0.02, 0.04])
def test_samples_that_come_a_little_late_slow_nothing(silence):
    led = Led()
    index = len(led.seen)
    for _ in range(5):
        led.run(silence)
        led.run(PERIOD, master=NEUTRAL)
    assert speeds(led.since(index)) == pytest.approx(SPEED)


def test_a_silence_that_ends_before_the_hold_only_slows_the_motion():
    led = Led()
    index = len(led.seen)
    led.run(0.08)
    led.run(0.5, master=NEUTRAL)
    assert {state.phase for state in led.seen[index:]} == {Phase.EXECUTE}
    assert accelerations(led.since(index)).max() <= 1.1 * BRAKING
    assert 0.0 < speeds(led.since(index)).min() < 0.9 * SPEED
