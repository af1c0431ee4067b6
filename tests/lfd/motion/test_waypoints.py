"""A motion through waypoints passes them, smoothly, at even times."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.exceptions import (
    InvalidDuration,
    LfdError,
    NotFinite,
    NotUnitQuaternion,
    TooFewPoints,
    TooFewWaypoints,
    WrongShape,
)
from lfd.motion.rotations import conjugate, exp_map, log_map, multiply
from lfd.motion.waypoints import Passing, passed_at, through_waypoints

IDENTITIES = np.tile([1.0, 0.0, 0.0, 0.0], (4, 1))
CORNERS = np.array([[0.5, 0.0, 0.4], [0.6, 0.1, 0.4], [0.7, 0.1, 0.5], [0.8, 0.0, 0.6]])


def some(seed, k):
    rng = np.random.default_rng(seed)
    return rng.uniform(-1.0, 1.0, (k, 3)), exp_map(rng.uniform(-1.5, 1.5, (k, 3)))


def turns(orientations):
    """Rotation vectors from each orientation to the next, in base axes."""
    return log_map(multiply(orientations[1:], conjugate(orientations[:-1])))


@given(seed=st.integers(0, 10_000), k=st.integers(3, 9), between=st.integers(1, 8))
def test_it_passes_every_waypoint_at_even_times(seed, k, between):
    positions, orientations = some(seed, k)
    motion = through_waypoints(positions, orientations, 10.0, n=between * (k - 1) + 1)
    np.testing.assert_allclose(motion.positions[::between], positions, atol=1e-12)
    cosines = np.abs(np.sum(motion.orientations[::between] * orientations, axis=1))
    np.testing.assert_allclose(cosines, 1.0, atol=1e-12)
    assert motion.duration == 10.0


@given(seed=st.integers(0, 10_000), n=st.integers(2, 100))
def test_it_begins_at_the_first_waypoint_and_ends_at_the_last_with_any_number_of_points(seed, n):
    positions, orientations = some(seed, 5)
    motion = through_waypoints(positions, orientations, 10.0, n)
    assert motion.n_points == n
    np.testing.assert_allclose(motion.positions[[0, -1]], positions[[0, -1]], atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(motion.orientations, axis=1), 1.0, atol=1e-12)


def test_waypoints_on_a_line_at_even_distances_are_passed_at_one_speed():
    positions = np.outer(np.arange(5), [0.1, -0.05, 0.02]) + CORNERS[0]
    motion = through_waypoints(positions, exp_map(np.outer(np.arange(5), [0.0, 0.2, 0.1])), 10.0, n=41)
    steps, turned = np.diff(motion.positions, axis=0), turns(motion.orientations)
    np.testing.assert_allclose(steps, np.tile(steps[0], (40, 1)), atol=1e-12)
    np.testing.assert_allclose(turned, np.tile(turned[0], (40, 1)), atol=1e-12)


@given(seed=st.integers(0, 10_000), signs=st.lists(st.sampled_from([-1.0, 1.0]), min_size=5, max_size=5))
def test_a_quaternion_and_its_negative_are_the_same_waypoint(seed, signs):
    positions, orientations = some(seed, 5)
    expected = through_waypoints(positions, orientations, 10.0)
    motion = through_waypoints(positions, np.array(signs)[:, None] * orientations, 10.0)
    np.testing.assert_array_equal(motion.orientations, signs[0] * expected.orientations)


def test_between_two_waypoints_it_turns_about_one_axis_at_a_constant_rate():
    orientations = exp_map(np.array([[0.0, 0.0, 0.0], [0.0, 0.8, 0.0], [0.6, 0.8, 0.0]]))
    turned = turns(through_waypoints(CORNERS[:3], orientations, 10.0, n=21).orientations)
    np.testing.assert_allclose(turned[:10], np.tile(turned[0], (10, 1)), atol=1e-12)
    np.testing.assert_allclose(turned[10:], np.tile(turned[10], (10, 1)), atol=1e-12)


def test_waypoints_may_coincide():
    motion = through_waypoints(CORNERS[[0, 1, 1, 2]], IDENTITIES, 10.0, n=31)
    np.testing.assert_allclose(motion.positions[[10, 20]], CORNERS[[1, 1]], atol=1e-12)
    still = through_waypoints(CORNERS[[0, 0, 0]], IDENTITIES[:3], 10.0)
    np.testing.assert_allclose(still.positions, np.tile(CORNERS[0], (75, 1)), atol=0.0)


@pytest.mark.parametrize("k", [0, 1, 2])
def test_fewer_than_three_waypoints_are_refused_with_their_number(k):
    with pytest.raises(TooFewWaypoints, match="at least 3") as caught:
        through_waypoints(CORNERS[:k], IDENTITIES[:k], 10.0)
    assert caught.value.count == k


@pytest.mark.parametrize(
    ("arguments", "error", "fact"),
    [
        ((CORNERS[:, :2], IDENTITIES, 1.0, 10), WrongShape, ("name", "positions")),
        ((CORNERS, IDENTITIES[:3], 1.0, 10), WrongShape, ("actual", (3, 4))),
        ((np.where(CORNERS == 0.7, np.nan, CORNERS), IDENTITIES, 1.0, 10), NotFinite, ("index", (2, 0))),
        ((CORNERS, 0.9 * IDENTITIES, 1.0, 10), NotUnitQuaternion, ("index", 0)),
        ((CORNERS, IDENTITIES, 0.0, 10), InvalidDuration, ("duration", 0.0)),
        ((CORNERS, IDENTITIES, 1.0, 1), TooFewPoints, ("count", 1)),
    ],
)
def test_what_are_no_waypoints_is_refused_with_the_fact(arguments, error, fact):
    with pytest.raises(error) as caught:
        through_waypoints(*arguments)
    assert getattr(caught.value, fact[0]) == fact[1]
    assert isinstance(caught.value, LfdError)
    assert "\n" not in str(caught.value)


@given(seed=st.integers(0, 10_000), k=st.integers(3, 9), passing=st.sampled_from(Passing))
def test_it_passes_every_waypoint_at_its_phase(seed, k, passing):
    positions, orientations = some(seed, k)
    phases = passed_at(positions, orientations, passing)
    motion = through_waypoints(positions, orientations, 10.0, n=20_001, passing=passing)
    nearest = np.round(phases * 20_000).astype(int)
    np.testing.assert_allclose(motion.positions[nearest], positions, atol=2e-3)
    np.testing.assert_allclose(np.abs(np.sum(motion.orientations[nearest] * orientations, axis=1)), 1.0, atol=1e-4)


@given(seed=st.integers(0, 10_000), k=st.integers(3, 9))
def test_centripetal_phases_grow_with_the_root_of_the_way(seed, k):
    positions, _ = some(seed, k)
    phases = passed_at(positions, np.tile(IDENTITIES[0], (k, 1)), Passing.CENTRIPETAL)
    roots = np.sqrt(np.linalg.norm(np.diff(positions, axis=0), axis=1))
    np.testing.assert_allclose(np.diff(phases), roots / np.sum(roots), atol=1e-12)


def test_waypoints_that_coincide_take_their_time_all_the_same():
    positions = np.repeat(CORNERS, 2, axis=0)
    motion = through_waypoints(positions, np.tile(IDENTITIES[0], (8, 1)), 10.0, passing=Passing.CENTRIPETAL)
    assert np.isfinite(motion.positions).all()


def test_where_waypoints_lie_unevenly_centripetal_passing_swings_out_less():
    positions = np.array([[0.0, 0.0, 0.0], [0.3, 0.0, 0.0], [0.32, 0.02, 0.0], [0.32, 0.3, 0.0]])
    even, centripetal = (
        through_waypoints(positions, IDENTITIES, 10.0, 500, passing).positions.max(axis=0)[0] for passing in Passing
    )
    assert 0.32 <= centripetal < even


@pytest.mark.parametrize("passing", ["even", 1])
def test_a_way_of_passing_is_one_of_those(passing):
    with pytest.raises(LfdError, match="passing"):
        through_waypoints(CORNERS, IDENTITIES, 10.0, passing=passing)
