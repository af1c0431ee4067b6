import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from services.offline.proportion import Proportion

COUNTS = st.integers(1, 500).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n)))


@given(COUNTS)
def test_the_interval_is_the_one_of_wilson(counts):
    from scipy.stats import binomtest

    expected = binomtest(*counts).proportion_ci(method="wilson")
    np.testing.assert_allclose(Proportion(*counts).interval, expected, atol=1e-12)


@given(COUNTS)
def test_it_holds_what_was_seen_and_is_a_probability(counts):
    low, high = Proportion(*counts).interval
    assert 0.0 <= low <= counts[0] / counts[1] <= high <= 1.0
    assert low < high


@given(COUNTS)
def test_failures_mirror_successes(counts):
    low, high = Proportion(*counts).interval
    mirrored = Proportion(counts[1] - counts[0], counts[1]).interval
    assert mirrored == pytest.approx((1.0 - high, 1.0 - low))


def test_it_is_said_with_its_interval():
    assert str(Proportion(3, 4)) == "75.0 %, 95 % interval 30 to 95 %"
    assert str(Proportion(20, 20)) == "100.0 %, 95 % interval 84 to 100 %"
    assert str(Proportion(0, 0)) == "none was tried"
    assert Proportion(0, 0).interval == (0.0, 1.0)
