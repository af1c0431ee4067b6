"""What corrections do is what the formulas say, written down once more: dense, entry by entry, with the numbers."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.models.adaptive.correction import CorrectionOptions
from lfd.models.adaptive.covariance import CovarianceOptions, Nearness, levy, open_variance
from lfd.models.adaptive.kinds import POSITION
from tests.lfd.models.adaptive.vectors import KINDS, D, correct, corrections, effect, regression, sized

EXTENT = 0.5
OPTIONS = CovarianceOptions(open_slope=1.7, near_std=0.03, value_std=0.06, near=0.4, reach=(2.5, 1.5, 4.0), beside=0.15)
UNITS = (EXTENT, 1.0, 1.0)


def taught(rng, M=6):
    """Demonstrations of a curved family."""
    conditions = rng.uniform(-0.2, 0.2, size=(M, 2))
    return regression(conditions, conditions @ rng.normal(size=(2, D)) + np.sin(9.0 * conditions[:, :1]))


class Reference:
    """The Gaussian process over the condition, in one kind.

    Args:
        kind: Of output.
        places: Of the corrections, shape (J, c).
        beyond: How far each lies outside what was shown, shape (J, c).
        changes: y_j, shape (J, D).
    """

    def __init__(self, kind, places, beyond, changes):
        self.kind, self.places, self.beyond, self.changes = kind, places, beyond, changes
        self.sizes = KINDS.sizes(changes)[kind]
        explained = [self.fixed(a, a, u, u) for a, u in zip(places, beyond, strict=True)]
        self.surprises = np.sqrt(np.maximum(self.sizes - explained, 0.0))

    def matern(self, a, b):
        r = np.sqrt(3.0) * np.linalg.norm(a - b) / OPTIONS.reach[self.kind]
        return (1.0 + r) * np.exp(-r)

    def fixed(self, a, b, beyond_a, beyond_b):
        """What was left open beyond the conditions shown, and the detail of one place."""
        lengths = np.linalg.norm(beyond_a), np.linalg.norm(beyond_b), np.linalg.norm(beyond_a - beyond_b)
        opened = 0.2 * OPTIONS.open_slope**2 * 0.5 * (lengths[0] + lengths[1] - lengths[2]) * self.matern(a, b)
        detail = OPTIONS.near_std**2 * np.exp(-np.linalg.norm(a - b) / OPTIONS.near)
        return UNITS[self.kind] ** 2 * (opened + detail)

    def surprise(self, a):
        """By which the world has changed there: as beside it."""
        shares = np.exp(-np.linalg.norm(self.places - a, axis=1) / OPTIONS.beside)
        return shares @ self.surprises / shares.sum()

    def changed(self, a, b):
        return self.surprise(a) * self.surprise(b) * self.matern(a, b)

    def covariance(self, a, b, beyond_a, beyond_b):
        return self.fixed(a, b, beyond_a, beyond_b) + self.changed(a, b)

    def details(self):
        """What of each change is one of its place; the rest is no larger than the change."""
        kept = KINDS.filtered(self.changes, (OPTIONS.value_std * np.array(UNITS)) ** 2)
        sizes = np.sqrt(KINDS.sizes(kept)[self.kind])
        return self.changes - (np.minimum(np.sqrt(self.sizes) / sizes, 1.0) * kept.T).T

    def effect(self, s, beyond):
        pairs = list(zip(self.places, self.beyond, strict=True))
        C = np.array([[self.covariance(a, b, u, v) for b, v in pairs] for a, u in pairs])
        c = np.array([self.covariance(s, b, beyond, v) for b, v in pairs])
        elsewhere = [self.changed(s, a) * (1.0 - np.exp(-np.linalg.norm(s - a) / OPTIONS.near)) for a in self.places]
        noisy = C + CorrectionOptions().noise * np.diag(np.diag(C))
        weights, carried = np.linalg.solve(noisy, c), np.linalg.solve(noisy, elsewhere)
        left = 1.0 - weights @ c / self.covariance(s, s, beyond, beyond)
        carried = np.sign(weights) * np.clip(np.sign(weights) * carried, 0.0, np.abs(weights))
        most = max(self.matern(s, a) for a in self.places)
        evidence = np.abs(weights).sum() ** 2 / (weights @ weights)
        change = weights @ self.changes - max(2.0 / evidence - 1.0, 0.0) * carried @ self.details()
        return change / max(np.abs(weights).sum() / most, 1.0), left, self.surprise(s) ** 2


@pytest.mark.parametrize("kind", range(3))
@pytest.mark.parametrize("size", [1e-4, 0.01, 0.1, 1.0], ids=["no surprise", "hardly one", "some", "a great one"])
def test_corrections_are_the_gaussian_process_of_what_was_open_and_of_what_surprises(rng, size, kind):
    fitted = taught(rng)
    places = rng.uniform(-0.6, 0.6, size=(5, 2))
    changes = np.array([sized(kind, size * rng.uniform(0.5, 1.0)) for _ in places])
    held = corrections(fitted, EXTENT, covariance=OPTIONS, same=0.0)
    for s, y in zip(places, changes, strict=True):
        held = correct(held, s, y)
    reference = Reference(kind, places, fitted.at_each(places)[1], changes)
    for s in (*places, *rng.uniform(-1.5, 1.5, size=(6, 2))):
        change, left, surprise = reference.effect(s, fitted.at(s).outside)
        got = effect(held, s)
        np.testing.assert_allclose(got.change, change, rtol=1e-7, atol=1e-9 * size)
        if kind == POSITION:
            assert got.open_share == pytest.approx(left, rel=1e-6)
            assert got.surprise == pytest.approx(surprise, rel=1e-9, abs=1e-20)


@given(st.integers(1, 12), st.integers(1, 4), st.integers(0, 2**32 - 1))
def test_each_part_is_a_covariance_wherever_the_places_lie(J, c, seed):
    rng = np.random.default_rng(seed)
    z, outside = rng.normal(size=(J, c)), rng.normal(size=(J, c))
    distances = np.linalg.norm(z[:, None] - z, axis=2)
    near = Nearness.of(distances, levy(outside, outside), OPTIONS)
    for part in (*near.fixed, *near.wide, levy(outside, outside)):
        np.testing.assert_allclose(part, part.T, atol=1e-12)
        assert np.linalg.eigvalsh(part).min() > -1e-10


def test_levy_s_motion_is_zero_about_the_origin_and_moves_as_the_square_root_of_the_distance(rng):
    a, b = rng.normal(size=(5, 3)), rng.normal(size=(4, 3))
    covariance = levy(a, b)
    increments = np.diag(levy(a, a))[:, None] + np.diag(levy(b, b)) - 2.0 * covariance
    np.testing.assert_allclose(increments, np.linalg.norm(a[:, None] - b, axis=2), atol=1e-12)
    np.testing.assert_array_equal(levy(np.zeros((1, 3)), b), 0.0)


def test_what_is_open_beyond_the_demonstrations_grows_with_the_distance():
    """A slope of one is meant at a fifth of a unit: there a motion has changed by as much."""
    options = CovarianceOptions(near_std=0.05)
    assert np.sqrt(open_variance(0.2, options) - 0.05**2) == pytest.approx(0.2)
    assert open_variance(0.0, options) == pytest.approx(0.05**2)
    steeper = CovarianceOptions(near_std=0.05, open_slope=3.0)
    assert open_variance(0.4, steeper) - 0.05**2 == pytest.approx(9.0 * 2.0 * 0.2**2)
