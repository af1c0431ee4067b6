"""Nowhere does a correction do more than it did where it was given, and far away it does nothing."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.models.adaptive.adaptation import AdaptiveOptions, AdaptiveProMP
from lfd.models.basis import GaussianBasis
from lfd.motion.demonstration import Demonstration
from lfd.motion.rotations import conjugate, exp_map, log_map, multiply
from lfd.motion.trajectory import Trajectory

N = 25
OPTIONS = AdaptiveOptions(GaussianBasis(count=8, width=0.1), samples=25)  # as the default's, in fewer numbers
HEIGHT = 0.1


def motion(place, side=0.0, roll=0.0, duration=5.0, lift=0.0):
    """To a place in the plane (2,); bent sideways, lifted [m], rolled on the way [rad], as long as it is said [s]."""
    t = np.linspace(0.0, 1.0, N)[:, None]
    smooth, bump = t * t * (3.0 - 2.0 * t), np.sin(np.pi * t)
    target = np.array([*place, HEIGHT])
    positions = smooth * target + bump * [0.0, side, 0.05 + lift]
    orientations = exp_map(smooth * [0.1, 0.0, -0.2] + bump * [roll, 0.0, 0.0])
    return Demonstration.reaching(Trajectory(positions, orientations, duration), target)


def departure(model, corrected, wanted):
    """Between predictions: most of the distance [m] and of the angle [rad], and of the logarithm of the duration."""
    before, after = (m.predict(wanted.situation, N).trajectory for m in (model, corrected))
    turned = log_map(multiply(conjugate(before.orientations), after.orientations))
    return np.array(
        [
            np.linalg.norm(after.positions - before.positions, axis=1).max(),
            np.linalg.norm(turned, axis=1).max(),
            abs(np.log(after.duration / before.duration)),
        ]
    )


def given_size(model, correction):
    """The same, between the correction and what was predicted before any."""
    at_it = model.updated(correction)
    return departure(model, at_it, correction)


WHAT = {
    "position": lambda x, way: {"side": 0.2 * x * way},
    "orientation": lambda x, way: {"roll": 0.8 * x * way},
    "duration": lambda x, way: {"duration": 5.0 * np.exp(1.1 * x * way)},
    "all": lambda x, way: {"side": 0.2 * x * way, "roll": 0.8 * x, "duration": 5.0 * np.exp(-1.1 * x * way)},
}


def layout(rng):
    """Somewhere around the middle of the reach; the demonstrations differ by what is left to chance."""
    return rng.uniform([0.25, -0.3], [0.6, 0.3])


def around(rng, count):
    """Places out to ten extents, most of them near."""
    angles, distances = rng.uniform(0.0, 2.0 * np.pi, count), 10.0 ** rng.uniform(-2.0, 0.7, count)
    return np.array([0.4, 0.0]) + distances[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])


@pytest.mark.parametrize("what", WHAT)
@given(st.integers(1, 4), st.integers(1, 4), st.booleans(), st.integers(0, 2**32 - 1))
def test_nowhere_is_more_changed_than_the_largest_correction_did(what, M, J, opposite, seed):
    rng = np.random.default_rng(seed)
    model = AdaptiveProMP.fit([motion(layout(rng), 0.05 * rng.normal()) for _ in range(M)], OPTIONS)
    corrected, most = model, np.zeros(3)
    for j in range(J):
        way = (-1.0) ** j if opposite else 1.0
        correction = motion(layout(rng), **WHAT[what](rng.uniform(0.2, 1.0), way))
        most = np.maximum(most, given_size(model, correction))
        corrected = corrected.updated(correction)
    for place in around(rng, 8):
        assert (departure(model, corrected, motion(place)) <= 1.25 * most + 1e-9).all()


@pytest.mark.parametrize("what", WHAT)
@given(st.integers(1, 4), st.integers(1, 4), st.integers(0, 2**32 - 1))
def test_ten_extents_away_hardly_anything_is_left_of_a_correction(what, M, J, seed):
    rng = np.random.default_rng(seed)
    model = AdaptiveProMP.fit([motion(layout(rng)) for _ in range(M)], OPTIONS)
    corrected, most = model, np.zeros(3)
    for _ in range(J):
        correction = motion(layout(rng), **WHAT[what](rng.uniform(0.2, 1.0), rng.choice([-1.0, 1.0])))
        most = np.maximum(most, given_size(model, correction))
        corrected = corrected.updated(correction)
    extent = model.corrections.extent
    for angle in rng.uniform(0.0, 2.0 * np.pi, 3):
        place = np.array([0.4, 0.0]) + 11.0 * extent * np.array([np.cos(angle), np.sin(angle)])
        assert (departure(model, corrected, motion(place)) <= 0.02 * most + 1e-9).all()


def test_one_lift_beside_one_demonstration_never_dips_on_the_other_side():
    model = AdaptiveProMP.fit([motion([0.4, 0.05])], OPTIONS)
    corrected = model.updated(motion([0.4, 0.15], lift=0.08))
    for y in np.linspace(-4.0, 4.0, 41):
        wanted = motion([0.4, y]).situation
        lifted = (corrected.predict(wanted, N).trajectory.positions - model.predict(wanted, N).trajectory.positions)[
            :, 2
        ]
        assert lifted.min() > -1e-6
        assert lifted.max() < 1.25 * 0.08


@pytest.mark.parametrize("apart", [0.02, 0.05, 0.1, 0.2])
def test_outside_two_opposite_corrections_nothing_swings_further_than_they_did(apart):
    model = AdaptiveProMP.fit([motion([0.4, 0.3]), motion([0.4, -0.3])], OPTIONS)
    corrected = model.updated(motion([0.4, 0.0], side=0.2)).updated(motion([0.4, apart], side=-0.2))
    for y in np.linspace(-1.5, 1.5, 31):
        assert departure(model, corrected, motion([0.4, y]))[0] <= 1.25 * 0.2


@pytest.mark.parametrize("M", [1, 2])
def test_a_roll_corrected_on_one_side_is_never_the_opposite_roll_on_the_other(M):
    model = AdaptiveProMP.fit([motion([0.4, 0.01]), motion([0.4, -0.1])][:M], OPTIONS)
    corrected = model.updated(motion([0.4, 0.2], roll=0.8))
    for y in (-0.2, -1.0, -3.0):
        wanted = motion([0.4, y])
        before, after = (m.predict(wanted.situation, N).trajectory.orientations for m in (model, corrected))
        rolled = log_map(multiply(after, conjugate(before)))[:, 0]
        assert rolled.min() > -0.01


@pytest.mark.parametrize("M", [1, 2])
def test_a_motion_made_slow_on_one_side_is_not_hurried_or_endless_on_the_other(M):
    model = AdaptiveProMP.fit([motion([0.4, 0.01]), motion([0.4, -0.1])][:M], OPTIONS)
    corrected = model.updated(motion([0.4, 0.2], duration=15.0))
    for y in (-0.3, -0.6, -1.0, -3.0, 1.0):
        assert 5.0 - 1e-6 <= corrected.predict(motion([0.4, y]).situation).trajectory.duration <= 15.1
