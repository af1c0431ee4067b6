import numpy as np
import pytest

from lfd.models.adaptive.moments import Moments


@pytest.mark.parametrize("owner", [[0, 1, 1, 2, 2, 2, 3, 3], [3, 1, 0, 2, 1, 2, 3, 2], [0, 1, 1, 1, 1, 1, 1, 1]])
def test_what_is_left_is_as_if_the_rest_had_never_been_there(rng, owner):
    S, X, owner = rng.normal(size=(8, 3)) + 2.0, rng.normal(size=(8, 4)) - 1.0, np.array(owner)
    without = Moments.without_each(S, X, owner)
    for g in range(owner.max() + 1):
        anew = Moments.of(S[owner != g], X[owner != g])
        for name in ("count", "s_mean", "mean", "scatter", "cross"):
            np.testing.assert_allclose(getattr(without, name)[g], getattr(anew, name), atol=1e-12)


def test_sums_of_products_lose_no_digits_far_from_the_origin(rng):
    S, X, owner = rng.normal(size=(8, 3)), rng.normal(size=(8, 4)), np.repeat(np.arange(4), 2)
    near, far = Moments.without_each(S, X, owner), Moments.without_each(S + 1e6, X - 1e6, owner)
    np.testing.assert_allclose(far.scatter, near.scatter, atol=1e-7)
    np.testing.assert_allclose(far.cross, near.cross, atol=1e-7)


def test_moments_are_means_and_centred_sums_of_products(rng):
    S, X = rng.normal(size=(8, 3)) + 2.0, rng.normal(size=(8, 4)) - 1.0
    moments = Moments.of(S, X)
    covariance = np.cov(np.column_stack([S, X]).T, bias=True)
    np.testing.assert_allclose(moments.scatter, 8 * covariance[:3, :3])
    np.testing.assert_allclose(moments.cross, 8 * covariance[:3, 3:])
    np.testing.assert_allclose(moments.s_mean, S.mean(axis=0))
    np.testing.assert_allclose(moments.mean, X.mean(axis=0))
