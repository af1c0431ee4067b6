"""How the rate changes, and where it comes to rest."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from services.robot.pace import FASTEST_PACE, SLEW, Pace

PERIOD = 0.01
RATES = st.floats(-FASTEST_PACE, FASTEST_PACE)


def steps(pace, now, count):
    """The steps of so many control periods, and the time after them."""
    taken = []
    for _ in range(count):
        taken.append(pace.step(now))
        now += taken[-1]
    return np.array(taken), now


def test_where_nothing_is_asked_each_period_is_one_to_the_last_bit():
    taken, now = steps(Pace(PERIOD), 0.0, 1000)
    assert set(taken.tolist()) == {1.0}
    assert now == 1000.0


@given(st.lists(RATES, min_size=1, max_size=8))
def test_the_rate_reaches_what_is_asked_and_never_changes_faster_than_it_may(rates):
    pace, before = Pace(PERIOD), 1.0
    for rate in rates:
        pace.ask(rate)
        taken, _ = steps(pace, 0.0, 101)  # from -2 to 2 at 4/s takes a second
        assert np.max(np.abs(np.diff(taken, prepend=before))) <= SLEW * PERIOD + 1e-12
        assert taken[-1] == pytest.approx(rate, abs=1e-12)
        before = taken[-1]


@given(st.floats(0.05, FASTEST_PACE), st.floats(0.0, 400.0), st.booleans())
def test_it_pauses_exactly_where_it_is_told_to_and_brakes_no_harder_than_it_may(rate, way, backwards):
    pace, sign = Pace(PERIOD), -1.0 if backwards else 1.0
    pace.ask(0.0)
    steps(pace, 0.0, 30)
    pace.ask(sign * rate, until=500.0 + sign * way)
    taken, now = steps(pace, 500.0, 20_000)
    assert now == pytest.approx(500.0 + sign * way, abs=1e-9)
    eighth_more = 1.125  # what is left in the last period may be a little less than the rate has to fall by
    assert np.max(np.abs(np.diff(taken, prepend=0.0))) <= eighth_more * SLEW * PERIOD + 1e-9
    assert (pace.asked, taken[-1]) == (0.0, 0.0)


def test_a_pause_that_lies_the_other_way_is_one_now():
    pace = Pace(PERIOD)
    pace.ask(1.0, until=99.0)
    taken, _ = steps(pace, 100.0, 30)
    assert (pace.asked, taken[-1]) == (0.0, 0.0)
