import numpy as np
import pytest

from lfd.models.adaptive.condensation import condensed
from lfd.models.adaptive.scale import ConditionScale
from tests.lfd.models.adaptive.vectors import unit_scale


def test_few_samples_stay_as_they_are(rng):
    conditions, vectors = rng.normal(size=(7, 3)), rng.normal(size=(7, 4))
    for kept, given in zip(condensed(conditions, vectors, 7, unit_scale(3)), (conditions, vectors), strict=True):
        np.testing.assert_array_equal(kept, given)


@pytest.mark.parametrize("M", [200, 1200])  # more than are compared at once, too
def test_many_samples_become_the_means_of_what_is_nearest(M, rng):
    centres = np.array([[0.0, 0.0], [10.0, 0.0], [0.0, 10.0]])
    owners = rng.integers(3, size=M)
    conditions = np.vstack([centres, centres[owners] + rng.uniform(-1.0, 1.0, size=(M, 2))])
    vectors = rng.normal(size=(M + 3, 5))
    owners = np.concatenate([np.arange(3), owners])
    few_conditions, few_vectors = condensed(conditions, vectors, 3, unit_scale(2))
    for i in range(3):
        np.testing.assert_allclose(few_conditions[i], conditions[owners == i].mean(axis=0))
        np.testing.assert_allclose(few_vectors[i], vectors[owners == i].mean(axis=0))


def test_nearness_is_in_units_of_the_scale():
    scale = ConditionScale(np.zeros(2), np.array([1.0, 100.0]), np.full(2, -1), np.ones(2))
    conditions, vectors = np.array([[0.0, 0.0], [1.0, 90.0], [0.1, 90.0]]), np.array([[0.0], [1.0], [4.0]])
    _, near_in_units = condensed(conditions, vectors, 2, scale)
    np.testing.assert_allclose(near_in_units, [[0.0], [2.5]])
    conditions[2] = 0.1, 30.0
    np.testing.assert_allclose(condensed(conditions, vectors, 2, scale)[1], [[2.0], [1.0]])


def test_the_weighted_mean_is_kept(rng):
    conditions, vectors = rng.normal(size=(50, 2)), rng.normal(size=(50, 3))
    few_conditions, few_vectors = condensed(conditions, vectors, 1, unit_scale(2))
    np.testing.assert_allclose(few_conditions[0], conditions.mean(axis=0))
    np.testing.assert_allclose(few_vectors[0], vectors.mean(axis=0))
