import numpy as np
import pytest

from lfd.models.adaptive.kinds import DURATION, ORIENTATION, POSITION, Kinds
from lfd.models.anchor import Anchor
from lfd.models.basis import GaussianBasis
from lfd.models.encoding import Encoding
from tests.lfd.models.adaptive.vectors import ENCODING, KINDS, D


def test_the_size_of_positions_is_their_mean_square_over_time(rng):
    X = rng.normal(size=(4, D))
    paths = ENCODING.positions(X, 25)
    np.testing.assert_allclose(KINDS.sizes(X)[POSITION], np.mean(np.sum(paths**2, axis=2), axis=1))


def test_the_size_of_orientations_is_the_mean_square_of_the_rotation_vector(rng):
    X = rng.normal(size=(4, D))
    rotations = ENCODING.rows(np.linspace(0.0, 1.0, 25)) @ X[:, :-1].reshape(4, 3, 6)[:, :, 3:]
    np.testing.assert_allclose(KINDS.sizes(X)[ORIENTATION], np.mean(np.sum(rotations**2, axis=2), axis=1))


def test_the_size_of_the_duration_is_the_square_of_its_logarithm(rng):
    X = rng.normal(size=(4, D))
    np.testing.assert_allclose(KINDS.sizes(X)[DURATION], X[:, -1] ** 2)


def test_each_entry_belongs_to_one_kind_and_changes_no_other():
    for kind, columns in enumerate(KINDS.columns):
        assert (KINDS.of_column[columns] == kind).all()
        for column in columns:
            sizes = KINDS.sizes(np.eye(D)[[column]])[:, 0]
            assert np.flatnonzero(sizes).tolist() == [kind]
    assert sorted(np.concatenate(KINDS.columns).tolist()) == list(range(D))


def test_what_is_measured_has_the_inner_products_of_the_functions(rng):
    X = rng.normal(size=(3, D))
    paths = ENCODING.positions(X, 25).reshape(3, -1)
    np.testing.assert_allclose(KINDS.measured(X)[POSITION] @ KINDS.measured(X)[POSITION].T, paths @ paths.T / 25)


def test_each_entry_of_positions_belongs_to_one_coordinate_and_changes_no_other():
    for column, axis in enumerate(KINDS.axis_of_column):
        path = ENCODING.positions(np.eye(D)[[column]], 25)[0]
        assert np.flatnonzero(np.abs(path).max(axis=0) > 0.0).tolist() == ([axis] if axis >= 0 else [])


def test_of_each_coordinate_at_each_phase_what_is_larger_than_departures_are_is_kept():
    """Wiener's y^3 / (y^2 + v), whatever the weights are that draw it."""
    t = np.linspace(0.0, 1.0, 75)
    encoding = Encoding(GaussianBasis(count=40, width=0.0256), 75, np.array([1.0, 0.0, 0.0, 0.0]), Anchor.straight())
    bump = np.sin(np.pi * t)[:, None] * [0.2, 0.02, -0.005, 0.3, 0.0, -0.04]
    x = np.append((encoding.solver(t) @ bump).ravel(), 0.1)
    v = np.array([0.02, 0.1, 0.05]) ** 2
    kept = Kinds.of(encoding).filtered(x[None], v)[0]
    of_output = np.repeat(v[:2], 3)
    np.testing.assert_allclose(encoding.rows(t) @ kept[:-1].reshape(40, 6), bump**3 / (bump**2 + of_output), atol=5e-4)
    assert kept[-1] == pytest.approx(0.1**3 / (0.1**2 + v[2]))


def test_the_largest_is_the_size_and_the_farthest_that_a_phase_goes(rng):
    X = rng.normal(size=(4, D))
    paths = KINDS.paths(X)
    sizes, peaks = KINDS.largest(X)
    np.testing.assert_allclose(sizes, KINDS.sizes(X))
    np.testing.assert_allclose(peaks[POSITION], np.sum(paths**2, axis=2).max(axis=1))
    np.testing.assert_allclose(peaks[DURATION], X[:, -1] ** 2)


def test_what_is_bounded_is_the_same_where_it_is_allowed_and_as_large_as_allowed_where_not(rng):
    x = rng.normal(size=D)
    own = KINDS.largest(x[None])[..., 0]
    np.testing.assert_array_equal(KINDS.bounded(x, own), x)
    allowed = own * [[0.25, 2.0, 1.0], [1.0, 0.01, 1.0]]
    bounded = KINDS.bounded(x, allowed)
    np.testing.assert_allclose(bounded, x * np.array([0.5, 0.1, 1.0])[KINDS.of_column])
    np.testing.assert_array_equal(KINDS.bounded(x, np.zeros((2, 3))), np.zeros(D))
