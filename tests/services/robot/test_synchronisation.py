"""Control periods settle just after the samples that they use."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from services.robot.synchronisation import DEADBAND_NS, GAIN, LARGEST_NS, MARGIN_NS, Synchronisation

PERIOD = 10_000_000


def waits(offset_ns, jitter=()):
    """How long each sample waited for its period, where the first waited `offset_ns`; jitter delays samples."""
    loop, started, waited = Synchronisation(PERIOD), offset_ns, []
    for i in range(600):
        received = started // PERIOD * PERIOD + (jitter[i % len(jitter)] if jitter else 0)
        if received > started:
            received -= PERIOD
        waited.append(started - received)
        loop.heard(started, received)
        started += PERIOD + loop.take_slew_ns()
    return waited


@given(st.integers(min_value=0, max_value=PERIOD - 1))
def test_whatever_the_phase_was_samples_soon_wait_for_the_margin(offset):
    tolerance = DEADBAND_NS + 1.0 / GAIN
    assert all(abs(wait - MARGIN_NS) <= tolerance for wait in waits(offset)[400:])


@given(st.integers(min_value=0, max_value=10**9), st.integers(min_value=0, max_value=PERIOD))
def test_a_period_changes_by_one_per_cent_at_most(started, wait):
    loop = Synchronisation(PERIOD)
    loop.heard(started + wait, started)
    assert abs(loop.take_slew_ns()) <= LARGEST_NS == PERIOD // 100


def test_without_a_new_sample_periods_are_as_long_as_ever():
    loop = Synchronisation(PERIOD)
    loop.heard(9_000_000, 0)
    loop.take_slew_ns()
    assert loop.take_slew_ns() == 0


def test_jitter_within_the_margin_delays_no_sample_by_a_period():
    assert max(waits(5_000_000, jitter=(0, 800_000, 300_000))[400:]) == pytest.approx(MARGIN_NS, abs=1_200_000)
