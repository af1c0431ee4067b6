import numpy as np
import pytest

from lfd.models.anchor import SAME, Anchor, fading
from lfd.motion.rotations import exp_map, matrix_from_quaternion

PHASES = np.linspace(0.0, 1.0, 201)
EXTENT = 0.5


@pytest.fixture
def starts(rng):
    return rng.normal(scale=0.03, size=(5, 6))


def test_a_motion_begins_at_its_start_and_ends_independently_of_it(starts, rng):
    start = rng.normal(size=6)
    at = Anchor.of(starts, EXTENT).at(start, PHASES)
    np.testing.assert_allclose(at[0], start, atol=1e-12)
    np.testing.assert_allclose(at[-1], 0.0, atol=1e-12)


def test_what_is_left_of_a_stray_start_only_falls_and_is_five_per_cent_soon():
    left = fading(PHASES)
    assert left[0] == 1.0
    assert np.all(np.diff(left) < 0.0)
    assert left[-1] == pytest.approx(0.0, abs=1e-15)
    assert fading(np.array([0.38]))[0] == pytest.approx(0.05, abs=0.003)


def test_the_rates_are_the_derivatives(starts, rng):
    anchor, start, step = Anchor.of(starts, EXTENT), rng.normal(size=6), 1e-6
    inside = PHASES[1:-1]
    after, before = (anchor.at(start, inside + sign * step) for sign in (1.0, -1.0))
    np.testing.assert_allclose(anchor.rates(start, inside), (after - before) / (2.0 * step), atol=1e-7)


def test_a_displacement_is_left_soon_where_starts_agree_and_straight_where_they_differ():
    starts = np.zeros((2, 6))
    starts[:, 0] = -0.5, 0.5  # far more than what counts as one
    anchor, little = Anchor.of(starts, EXTENT), 0.1 * (SAME * EXTENT / 0.5) ** 4
    along, across = (anchor.at(0.1 * np.eye(6)[axis], PHASES)[:, axis] for axis in (0, 1))
    np.testing.assert_allclose(along, 0.1 * (1.0 - PHASES), atol=little)
    np.testing.assert_allclose(across, 0.1 * fading(PHASES), atol=little)


def test_of_a_single_start_every_other_is_blended_out_straight(rng):
    home, start = rng.normal(size=(2, 6))
    np.testing.assert_allclose(Anchor.of(home[None], EXTENT).at(start, PHASES), np.outer(1.0 - PHASES, start))


def test_how_the_frame_is_turned_does_not_matter(starts, rng):
    both = np.kron(np.eye(2), matrix_from_quaternion(exp_map(rng.normal(size=3))))
    start = rng.normal(size=6)
    turned = Anchor.of(starts @ both.T, EXTENT).at(both @ start, PHASES)
    np.testing.assert_allclose(turned, Anchor.of(starts, EXTENT).at(start, PHASES) @ both.T, atol=1e-12)
