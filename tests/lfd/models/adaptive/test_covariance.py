"""What corrections do is what the formulas say, written down once more: dense, entry by entry, with the numbers."""

import numpy as np
import pytest

from lfd.models.adaptive.correction import CorrectionOptions, Corrections
from lfd.models.adaptive.regression import Regression, RegressionOptions

EXTENT = 0.5


def regression(rng, M=6):
    """Demonstrations of a curved family, whose error is measured in three combinations of its four numbers."""
    conditions = rng.uniform(-0.2, 0.2, size=(M, 2))
    vectors = conditions @ rng.normal(size=(2, 4)) + np.sin(9.0 * conditions[:, :1])
    return Regression(conditions, vectors, rng.normal(size=(4, 3)), EXTENT, RegressionOptions())


class Reference:
    """The Gaussian process over the condition.

    Args:
        regression: What is corrected.
        places: s_j, shape (J, 2).
        changes: y_j, shape (J, 4).
    """

    def __init__(self, regression, places, changes):
        self.regression, self.places, self.changes = regression, places, changes
        self.middle = regression.conditions.mean(axis=0)
        deviations = regression.conditions - self.middle
        self.slope_covariance = np.linalg.inv(np.eye(2) + deviations.T @ deviations / (0.02 * EXTENT) ** 2)
        S = regression.conditions
        K = np.array([[self.near(a, b) for b in S] for a in S])
        self.inverse = np.linalg.inv(K + regression.options.noise * np.eye(len(S)))
        squares = np.sum((changes @ regression.measure) ** 2, axis=1)
        excess = squares - [self.open(s, s) for s in places]
        self.surprise = max(excess.mean(), 0.0)
        self.surprising_share = self.surprise / squares.mean()

    def near(self, a, b):
        return np.exp(-np.sum((a - b) ** 2) / (2.0 * self.regression.length**2))

    def open(self, a, b):
        k_a, k_b = (np.array([self.near(s, x) for x in self.regression.conditions]) for s in (a, b))
        mean = (0.02 * EXTENT) ** 2 / len(self.inverse)
        slope = (a - self.middle) @ self.slope_covariance @ (b - self.middle)
        return mean + slope + (0.003 * EXTENT) ** 2 * (self.near(a, b) - k_a @ self.inverse @ k_b)

    def covariance(self, a, b):
        r = np.sqrt(3.0) * np.linalg.norm(a - b) / (2.5 * EXTENT)
        return self.open(a, b) + self.surprise * (1.0 + r) * np.exp(-r)

    def effect(self, s):
        C = np.array([[self.covariance(a, b) for b in self.places] for a in self.places])
        newer = [sum(self.near(a, b) ** 4 for b in self.places[i + 1 :]) for i, a in enumerate(self.places)]
        inverse = np.linalg.inv(C + np.diag(np.diag(C) * (0.003 + 2.0 * np.array(newer))))
        c = np.array([self.covariance(s, a) for a in self.places])
        return c @ inverse @ self.changes, 1.0 - c @ inverse @ c / self.covariance(s, s)


@pytest.mark.parametrize("size", [1e-4, 3e-3, 0.02, 1.0], ids=["no surprise", "hardly one", "some", "a great one"])
def test_corrections_are_the_gaussian_process_of_what_was_open_and_of_what_surprises(rng, size):
    taught = regression(rng)
    places, changes = rng.uniform(-0.2, 0.2, size=(5, 2)), size * rng.normal(size=(5, 4))
    reference, corrections = Reference(taught, places, changes), Corrections.none(taught, CorrectionOptions())
    for s, y in zip(places, changes, strict=True):
        corrections = corrections.added(taught.at(s), taught.mean(s) + y)
    assert corrections.surprise == pytest.approx(reference.surprise, rel=1e-9)
    assert corrections.surprising_share == pytest.approx(reference.surprising_share, rel=1e-9)
    for s in (*places, *rng.uniform(-0.4, 0.4, size=(4, 2))):
        change, open_share = reference.effect(s)
        effect = corrections.effect(taught.at(s))
        np.testing.assert_allclose(effect.change, change, rtol=1e-7, atol=1e-9 * size)
        assert effect.open_share == pytest.approx(open_share, rel=1e-6)


def test_what_was_never_corrected_holds_no_surprise(rng):
    none = Corrections.none(regression(rng), CorrectionOptions())
    assert none.surprise == none.surprising_share == 0.0


def test_one_demonstration_leaves_open_that_a_motion_changes_as_much_as_its_condition(rng):
    none = Corrections.none(regression(rng, M=1), CorrectionOptions())
    np.testing.assert_allclose(none.slope_covariance, np.eye(2), rtol=1e-12)


def test_two_hundred_corrections_are_kept(rng):
    corrections = Corrections.none(regression(rng, M=2), CorrectionOptions())
    for s in rng.uniform(-0.2, 0.2, size=(201, 2)):
        corrections = corrections.added(corrections.regression.at(s), np.ones(4))
    assert len(corrections) == 200
