"""A demonstration that lingered, with points evenly along its way: nowhere does it jump (thesis, Fig. 29)."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.exceptions import TooFewPoints
from lfd.motion.resampling import TURN_AS_WAY, along_the_way, from_samples, resample
from lfd.motion.rotations import conjugate, exp_map, log_map, multiply
from lfd.motion.trajectory import Trajectory

POINTS = st.integers(75, 500)
STILL = 0.005
shares = st.lists(st.floats(0.05, 0.95), min_size=0, max_size=4)


def way(t):
    """A bent way with a turn, by the share of it."""
    t = np.asarray(t)[:, None]
    return t * [0.5, 0.0, 0.2] + np.sin(np.pi * t) * [0.0, 0.1, 0.1], exp_map(t * [0.0, 0.6, 0.3])


def shown(lingering=(), seconds=4.0, tremor=0.0):
    """Led in 6 s at 25 Hz, with a pause at each of some shares of the way."""
    t, times = np.linspace(0.0, 1.0, 151), np.arange(151) / 25.0
    rng = np.random.default_rng(0)
    for share in lingering:
        i = int(np.searchsorted(t, share))
        pause = np.arange(1, round(25 * seconds) + 1) / 25.0
        times = np.concatenate([times[: i + 1], times[i] + pause, times[i + 1 :] + seconds])
        t = np.concatenate([t[: i + 1], np.full(len(pause), t[i]), t[i + 1 :]])
    positions, orientations = way(t)
    return from_samples(times, positions + rng.normal(0.0, tremor, positions.shape), orientations, len(times))


def steps(motion):
    turns = log_map(multiply(conjugate(motion.orientations[:-1]), motion.orientations[1:]))
    return np.linalg.norm(np.diff(motion.positions, axis=0), axis=1) + TURN_AS_WAY * np.linalg.norm(turns, axis=1)


@given(shares, POINTS)
def test_however_it_lingered_no_step_is_longer_than_its_share_of_the_way(lingering, n):
    motion = shown(lingering)
    even = along_the_way(motion, n)
    assert np.max(steps(even)) <= np.sum(steps(motion)) / (n - 1) + 1e-9
    assert even.n_points == n
    assert even.duration == motion.duration


@given(shares, POINTS)
def test_lingering_changes_nothing_of_the_way(lingering, n):
    np.testing.assert_allclose(
        along_the_way(shown(lingering), n).positions, along_the_way(shown(), n).positions, atol=STILL
    )


def test_at_equal_times_the_same_lingering_makes_it_jump():
    """What the law above is there for."""
    lingered = shown([0.5], seconds=60.0)
    assert np.max(steps(resample(lingered, 75))) > 5 * np.max(steps(along_the_way(lingered, 75)))


@given(st.floats(0.0, 0.001))
def test_a_hand_that_trembles_while_it_lingers_takes_no_points(tremor):
    even = along_the_way(shown([0.4], seconds=30.0, tremor=tremor), 75)
    near = np.linalg.norm(even.positions - way([0.4])[0], axis=1) < 0.02
    assert np.count_nonzero(near) < 12


@given(shares, POINTS)
def test_it_begins_and_ends_where_it_did_and_leaves_the_way_nowhere(lingering, n):
    motion = shown(lingering)
    even = along_the_way(motion, n)
    np.testing.assert_allclose(even.positions[[0, -1]], motion.positions[[0, -1]], atol=1e-12)
    apart = np.min(np.linalg.norm(even.positions[:, None] - way(np.linspace(0.0, 1.0, 2000))[0], axis=2), axis=1)
    assert np.max(apart) <= STILL


def test_a_turn_on_the_spot_gets_its_points():
    turns = np.concatenate([np.zeros(50), np.linspace(0.0, 1.0, 50)])[:, None] * [0.0, 0.0, 1.0]
    even = along_the_way(Trajectory(np.zeros((100, 3)), exp_map(turns), 4.0), 75)
    angles = np.linalg.norm(log_map(even.orientations), axis=1)
    np.testing.assert_allclose(np.diff(angles), 1.0 / 74, atol=2e-3)


def test_a_motion_that_stands_stays_where_it_is():
    still = Trajectory(np.zeros((10, 3)), np.tile([1.0, 0.0, 0.0, 0.0], (10, 1)), 4.0)
    assert not along_the_way(still, 75).positions.any()


def test_one_point_is_no_motion():
    with pytest.raises(TooFewPoints):
        along_the_way(shown(), 1)
