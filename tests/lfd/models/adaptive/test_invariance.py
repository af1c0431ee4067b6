"""What a model must not depend on: units, order, signs, the origin; and what holds whatever it learnt."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.models.adaptive.adaptation import AdaptiveProMP
from lfd.motion.demonstration import Demonstration, Situation
from lfd.motion.rotations import exp_map
from lfd.motion.trajectory import Trajectory
from tests.lfd.models.adaptive.motions import (
    LEFT,
    MIDDLE,
    RIGHT,
    anything,
    decoded,
    gap,
    path,
    predict,
    scaled,
    straight,
)


@pytest.fixture
def model(reach):
    return AdaptiveProMP.fit([reach(LEFT), reach(RIGHT)])


@pytest.fixture
def recipe(reach):
    """Demonstrations, a correction and a wanted motion in general position."""
    places = [[0.9, 0.3, 0.6], [0.85, 0.05, 0.62], [0.92, -0.3, 0.58], [0.8, -0.1, 0.65], [0.95, 0.15, 0.5]]
    demonstrations = [reach(place, bend=0.05 * i, duration=4.0 + i) for i, place in enumerate(places)]
    return demonstrations, reach([0.88, 0.1, 0.6], bend=0.2), reach([0.9, 0.0, 0.55])


@pytest.mark.parametrize("seed", range(3))
def test_a_linear_family_is_recovered_exactly_also_where_nothing_was_taught(seed):
    rng = np.random.default_rng(seed)
    model = AdaptiveProMP.fit([straight(s) for s in rng.uniform(-0.3, 0.3, size=(7, 2))])
    for s in rng.uniform(-1.0, 1.0, size=(5, 2)):
        np.testing.assert_allclose(path(model, straight(s)), decoded(model, straight(s)), atol=1e-10)


def test_metres_and_millimetres_give_the_same(reach, recipe):
    """Lengths are relative to the motions' own extent; only the unit of the result changes."""
    demonstrations, correction, wanted = recipe
    small = AdaptiveProMP.fit(demonstrations).updated(correction).predict(wanted.situation)
    large = AdaptiveProMP.fit([scaled(d) for d in demonstrations]).updated(scaled(correction))
    prediction = large.predict(scaled(wanted).situation)
    np.testing.assert_allclose(prediction.trajectory.positions, 1e3 * small.trajectory.positions, rtol=1e-9, atol=1e-7)
    np.testing.assert_allclose(prediction.position_covariances, 1e6 * small.position_covariances, rtol=1e-8, atol=1e-4)


def measured(demonstration, d, factor):
    """The same, one number of its condition in another unit."""
    units = np.ones(demonstration.condition.size)
    units[d] = factor
    return replace(demonstration, condition=demonstration.condition * units)


@pytest.mark.parametrize("factor", [0.01, 100.0])
@pytest.mark.parametrize("d", range(5))
def test_the_unit_of_one_number_of_the_condition_makes_no_difference(reach, d, factor):
    """A place of three numbers, an object's size, and one that never varied until it was corrected."""
    rng = np.random.default_rng(1)

    def described(one, size, other=7.0):
        return replace(one, condition=np.array([*one.condition, size, other]))

    places = rng.uniform([0.7, -0.3, 0.5], [0.95, 0.3, 0.7], size=(9, 3))
    sizes = rng.uniform(0.02, 0.08, size=9)
    taught = [described(reach(p, bend=4.0 * s), s) for p, s in zip(places, sizes, strict=True)]
    told = [described(reach(places[0], bend=0.3), 0.05), described(reach(places[1], bend=0.2), 0.04, 9.0)]
    wanted = described(reach([0.8, 0.1, 0.6]), 0.05, 8.0)

    def predicted(by):
        model = AdaptiveProMP.fit([measured(x, d, by) for x in taught])
        for one in told:
            model = model.updated(measured(one, d, by))
        return model.predict(measured(wanted, d, by).situation)

    plain, other = predicted(1.0), predicted(factor)
    np.testing.assert_allclose(other.trajectory.positions, plain.trajectory.positions, rtol=1e-6, atol=1e-7)
    largest = np.abs(plain.position_covariances).max()
    np.testing.assert_allclose(other.position_covariances, plain.position_covariances, rtol=1e-6, atol=1e-6 * largest)
    assert other.trajectory.duration == pytest.approx(plain.trajectory.duration, rel=1e-6)
    assert other.known == pytest.approx(plain.known, rel=1e-6)


def test_the_order_of_the_demonstrations_does_not_matter(recipe):
    demonstrations, correction, wanted = recipe
    there = AdaptiveProMP.fit(demonstrations).updated(correction).predict(wanted.situation)
    back = AdaptiveProMP.fit(demonstrations[::-1]).updated(correction).predict(wanted.situation)
    np.testing.assert_allclose(back.trajectory.positions, there.trajectory.positions, atol=1e-9)
    np.testing.assert_allclose(back.position_covariances, there.position_covariances, atol=1e-9)


def test_the_sign_of_quaternions_does_not_matter(recipe):
    demonstrations, correction, wanted = recipe

    def flipped(d):
        return replace(d, trajectory=replace(d.trajectory, orientations=-d.trajectory.orientations))

    plain = AdaptiveProMP.fit(demonstrations).updated(correction).predict(wanted.situation)
    other = AdaptiveProMP.fit([flipped(d) for d in demonstrations]).updated(flipped(correction))
    prediction = other.predict(flipped(wanted).situation)
    np.testing.assert_allclose(prediction.trajectory.positions, plain.trajectory.positions, atol=1e-9)
    same = np.abs(np.sum(prediction.trajectory.orientations * plain.trajectory.orientations, axis=1))
    np.testing.assert_allclose(same, 1.0, atol=1e-9)


@given(st.integers(1, 5), st.integers(1, 4), st.integers(0, 3), st.integers(0, 2**32 - 1))
def test_whatever_was_taught_covariances_are_positive_and_orientations_unit(M, c, J, seed):
    rng = np.random.default_rng(seed)
    model = AdaptiveProMP.fit([anything(rng, c) for _ in range(M)])
    for _ in range(J):
        model = model.updated(anything(rng, c))
    wanted = anything(rng, c)
    prediction = model.predict(wanted.situation)
    least = np.linalg.eigvalsh(prediction.position_covariances).min()
    assert least >= -1e-12 * np.abs(prediction.position_covariances).max()
    np.testing.assert_allclose(np.linalg.norm(prediction.trajectory.orientations, axis=1), 1.0, atol=1e-12)
    np.testing.assert_allclose(prediction.trajectory.positions[0], wanted.trajectory.positions[0], atol=1e-9)
    distribution = model.distribution(wanted.situation)
    covariances = distribution.position_covariances(75)
    np.testing.assert_allclose(covariances, prediction.position_covariances, atol=1e-9 * np.abs(covariances).max())


@given(st.tuples(*[st.floats(-0.5, 0.5)] * 3), st.tuples(*[st.floats(-1.0, 1.0)] * 3))
def test_a_prediction_begins_at_the_start_pose(position, target):
    orientation = exp_map(np.array(position))
    line = Trajectory(np.linspace([0.0, 0.0, 0.0], [0.4, 0.2, 0.1], 20), np.tile([1.0, 0, 0, 0], (20, 1)), 5.0)
    model = AdaptiveProMP.fit([Demonstration.reaching(line, np.array([0.5, 0.2, 0.1]))])
    trajectory = model.predict(Situation.reaching(np.array(target), np.array(position), orientation)).trajectory
    np.testing.assert_allclose(trajectory.positions[0], position, atol=1e-9)
    assert abs(trajectory.orientations[0] @ orientation) == pytest.approx(1.0)
    assert trajectory.n_points == 75


@pytest.mark.parametrize(
    "targets",
    [[LEFT], [LEFT, LEFT], [LEFT, LEFT, LEFT], [LEFT, MIDDLE, RIGHT]],
    ids=["one demonstration", "two at one condition", "three at one condition", "collinear conditions"],
)
def test_degenerate_conditions_still_predict_well(reach, targets):
    model = AdaptiveProMP.fit([reach(target) for target in targets])
    assert gap(model, reach(targets[-1])) < 0.01
    assert gap(model, reach([0.9, 0.25, 0.62])) < 0.1


def test_moving_the_whole_world_moves_the_prediction(model, reach):
    offset = np.array([0.4, -1.0, 0.2])
    here = reach(MIDDLE)
    start = here.trajectory
    situation = Situation.reaching(here.origin + offset, start.positions[0] + offset, start.orientations[0])
    there = model.predict(situation, 60)
    expected = predict(model, here).trajectory.positions + offset
    np.testing.assert_allclose(there.trajectory.positions, expected, atol=1e-9)


def test_a_new_place_extends_the_trend(reach):
    """What was taught at a far condition helps beyond it: the trend learns from conditions that are new."""

    def bent(y):
        return reach([0.9, y, 0.6], bend=y)

    model = AdaptiveProMP.fit([bent(-0.3)])
    assert gap(model.updated(bent(0.0)).updated(bent(0.3)), bent(0.5)) < 0.6 * gap(model, bent(0.5))
