import numpy as np
import pytest

from lfd.models.adaptive.age import aged


@pytest.mark.parametrize("times", [(), (0.0, 1e9), (None, 5.0)])
def test_without_a_half_life_nothing_ages(times):
    np.testing.assert_array_equal(aged(times, None), np.zeros(len(times)))


def test_the_variance_is_one_more_at_each_half_life_s_doubling():
    np.testing.assert_allclose(aged([0.0, 10.0, 20.0], 10.0), [3.0, 1.0, 0.0])


def test_what_has_no_time_is_as_new_as_the_newest():
    np.testing.assert_allclose(aged([0.0, None, 10.0], 10.0), [1.0, 0.0, 0.0])
    np.testing.assert_array_equal(aged([None, None], 10.0), [0.0, 0.0])


def test_whatever_its_age_the_variance_is_finite():
    assert np.isfinite(aged([0.0, 1e300], 1e-3)).all()
