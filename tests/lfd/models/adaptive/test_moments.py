import numpy as np
import pytest

from lfd.models.adaptive.moments import Moments


@pytest.mark.parametrize("gone", [[0], [2, 5], [0, 1, 2, 3, 4, 5, 6]])
def test_what_is_left_is_as_if_the_rest_had_never_been_there(rng, gone):
    S, X = rng.normal(size=(8, 3)) + 2.0, rng.normal(size=(8, 4)) - 1.0
    kept = np.setdiff1d(np.arange(8), gone)
    without, anew = Moments.of(S, X).without(S[gone], X[gone]), Moments.of(S[kept], X[kept])
    assert without.count == anew.count
    for name in ("s_mean", "mean", "scatter", "cross"):
        np.testing.assert_allclose(getattr(without, name), getattr(anew, name), atol=1e-12)


def test_moments_are_means_and_centred_sums_of_products(rng):
    S, X = rng.normal(size=(8, 3)) + 2.0, rng.normal(size=(8, 4)) - 1.0
    moments = Moments.of(S, X)
    covariance = np.cov(np.column_stack([S, X]).T, bias=True)
    np.testing.assert_allclose(moments.scatter, 8 * covariance[:3, :3])
    np.testing.assert_allclose(moments.cross, 8 * covariance[:3, 3:])
    np.testing.assert_allclose(moments.s_mean, S.mean(axis=0))
    np.testing.assert_allclose(moments.mean, X.mean(axis=0))
