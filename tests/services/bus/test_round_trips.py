"""Another machine's clock by round trips: as well as half of the fastest one, whatever stands on the way, and anew."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from services.bus.round_trips import KEPT, SPAN_NS, RoundTrips

MS = 1_000_000
PERIOD_NS = 10 * MS
NOW_NS = 10**15


class Away:
    """A machine whose clock shows so much more, at the end of a way."""

    def __init__(self, ahead_ns):
        self.ahead_ns = ahead_ns
        self.trips = RoundTrips()
        self.now_ns = NOW_NS

    def answer(self, there_ns, back_ns, held_ns=3 * MS):
        """It hears ours and sends its own; the stamp on that."""
        self.now_ns += PERIOD_NS
        echoed = self.now_ns - there_ns - held_ns - back_ns
        stamp = self.now_ns - back_ns + self.ahead_ns
        self.trips.hear(echoed, held_ns, stamp, self.now_ns)
        return stamp

    def error_ns(self):
        return self.trips.fastest.offset_ns - self.ahead_ns


def test_before_the_first_trip_no_age_is_known():
    assert RoundTrips().age_ns(0, NOW_NS) is None


@given(
    st.integers(-(10**15), 10**15),
    st.lists(st.tuples(st.integers(MS, 400 * MS), st.integers(MS, 400 * MS)), min_size=1, max_size=100),
)
def test_the_offset_is_known_as_well_as_half_of_the_fastest_trip(ahead_ns, ways):
    away = Away(ahead_ns)
    for there, back in ways:
        away.answer(there, back)
    assert abs(away.error_ns()) <= away.trips.fastest.there_and_back_ns // 2 + 1


def test_over_a_way_as_long_there_as_back_the_age_is_the_time_on_the_way():
    away = Away(5_000 * MS)
    for _ in range(10):
        stamp = away.answer(75 * MS, 75 * MS)
    assert away.trips.age_ns(stamp, away.now_ns) == pytest.approx(75 * MS, abs=2)


def test_a_queue_that_stands_one_way_for_seconds_is_not_taken_for_the_way():
    away = Away(-70_000 * MS)
    away.answer(20 * MS, 20 * MS)
    for _ in range(KEPT * SPAN_NS // PERIOD_NS - 20):
        stamp = away.answer(20 * MS, 320 * MS)
    assert away.trips.age_ns(stamp, away.now_ns) == pytest.approx(320 * MS, abs=2)


@pytest.mark.parametrize("jump_s", [-28 * 3600.0, -0.5, 0.5, 20.0])
def test_a_clock_that_jumped_is_learnt_anew_from_the_next_trip(jump_s):
    away = Away(0)
    for _ in range(300):
        away.answer(50 * MS, 50 * MS)
    away.ahead_ns += round(jump_s * 1e9)
    away.answer(50 * MS, 50 * MS)
    assert abs(away.error_ns()) <= 1


def test_clocks_that_drift_apart_are_followed():
    away, rng = Away(0), np.random.default_rng(3)
    for _ in range(60 * 100):
        away.ahead_ns += round(500e-6 * PERIOD_NS)
        away.answer(*(round(way) for way in rng.uniform(40 * MS, 60 * MS, 2)))
    assert abs(away.error_ns()) <= 15 * MS


def test_who_answers_before_being_asked_is_not_believed():
    trips = RoundTrips()
    trips.hear(NOW_NS + 1, 0, NOW_NS, NOW_NS)
    trips.hear(NOW_NS - 10, 11, NOW_NS, NOW_NS)
    assert trips.fastest is None
