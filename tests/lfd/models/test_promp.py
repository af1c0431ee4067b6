from dataclasses import replace

import numpy as np
import pytest

from lfd.exceptions import NotFinite, TooFewDemonstrations
from lfd.models.basis import GaussianBasis
from lfd.models.promp import ConditionedProMP, PrompOptions
from lfd.motion.alignment import Selection
from lfd.motion.demonstration import Situation
from lfd.motion.provenance import Provenance
from lfd.motion.refinement import refine
from lfd.motion.resampling import resample

OBJECTS = [[0.9, -0.2, 0.6], [0.9, 0.0, 0.65], [0.85, 0.2, 0.6], [0.95, 0.1, 0.55]]


def to(target, demonstration):
    """Reaching for another object from where a demonstration started."""
    trajectory = demonstration.trajectory
    return Situation.reaching(np.array(target), trajectory.positions[0], trajectory.orientations[0])


@pytest.fixture
def demonstrations(reach):
    return [reach(target, bend=0.1 * i, duration=4.0 + i) for i, target in enumerate(OBJECTS)]


def test_mean_is_that_of_one_model_for_each_output(demonstrations):
    """Equations (1) to (12), written out for the x, y and z of the thesis one by one."""
    target = np.array([0.9, 0.05, 0.6])
    predicted = ConditionedProMP.fit(demonstrations).predict(to(target, demonstrations[0]), n=50)
    basis = GaussianBasis(10, 0.1)
    s = np.array([10.0 * d.condition for d in demonstrations])
    wanted = 10.0 * to(target, demonstrations[0]).condition
    for axis in range(3):
        w = np.array(
            [
                np.linalg.lstsq(
                    basis.matrix(np.linspace(0, 1, 10)),
                    resample(d.trajectory, 10).positions[:, axis] - d.origin[axis],
                    rcond=None,
                )[0]
                for d in demonstrations
            ]
        )
        Sigma = np.cov(np.hstack([w, s]).T)
        gain = Sigma[:10, 10:] @ np.linalg.inv(Sigma[10:, 10:] + 0.03 * np.eye(3))
        mean = basis.matrix(np.linspace(0, 1, 50)) @ (w.mean(axis=0) + gain @ (wanted - s.mean(axis=0)))
        np.testing.assert_allclose(predicted.trajectory.positions[:, axis], mean + target[axis], atol=1e-8)


def test_by_the_thesis_selection_two_of_a_condition_are_learnt_from(demonstrations, reach):
    repeated = [*demonstrations, reach(OBJECTS[0], bend=0.02), reach(OBJECTS[0], bend=0.3)]
    assert ConditionedProMP.fit(repeated).joint.count == 6
    pair = PrompOptions(selection=Selection.SIMILAR_PAIR)
    assert ConditionedProMP.fit(repeated, pair).joint.count == 5


def test_the_duration_is_certain_where_the_condition_tells_all_of_it(demonstrations):
    """The variance that is left is zero but for rounding, on either side."""
    for scale in np.geomspace(0.1, 10.0, 20):
        along = [replace(d, condition=scale * np.log([d.trajectory.duration])) for d in demonstrations]
        model = ConditionedProMP.fit(along, PrompOptions(conditioning_noise=1e-20))
        assert model.predict(along[0].situation).duration_std == pytest.approx(0.0, abs=1e-6)


def test_an_update_equals_a_fit_of_all(demonstrations):
    updated = ConditionedProMP.fit(demonstrations).updated(demonstrations[1]).joint
    at_once = ConditionedProMP.fit([*demonstrations, demonstrations[1]])
    np.testing.assert_allclose(updated.covariance[-3:, -3:], at_once.joint.covariance[-3:, -3:], atol=1e-12)
    np.testing.assert_allclose(updated.mean[-4:], at_once.joint.mean[-4:], atol=1e-12)


def test_an_update_leaves_the_old_model_as_it_was(demonstrations, reach):
    model = ConditionedProMP.fit(demonstrations)
    before = model.predict(demonstrations[0].situation)
    model.updated(reach([0.9, 0.0, 0.6], bend=0.5))
    after = model.predict(demonstrations[0].situation)
    np.testing.assert_array_equal(before.trajectory.positions, after.trajectory.positions)


def test_one_demonstration_predicts_itself_relative_to_the_object(demonstrations):
    only = demonstrations[0]
    predicted = ConditionedProMP.fit([only]).predict(to(only.origin + 0.1, only), n=10)
    expected = resample(only.trajectory, 10).positions + 0.1
    np.testing.assert_allclose(predicted.trajectory.positions, expected, atol=1e-8)
    assert predicted.trajectory.duration == pytest.approx(only.trajectory.duration)


def test_uncertainty_is_at_least_the_observation_noise(demonstrations):
    options = PrompOptions(observation_std=0.02)
    model = ConditionedProMP.fit(demonstrations, options)
    covariances = model.predict(to(OBJECTS[0], demonstrations[0])).position_covariances
    assert covariances.shape == (75, 3, 3)
    assert np.linalg.eigvalsh(covariances).min() >= 0.02**2 - 1e-12


def test_nothing_to_learn_from_and_an_unseen_object_are_refused(demonstrations):
    with pytest.raises(TooFewDemonstrations):
        ConditionedProMP.fit([])
    with pytest.raises(NotFinite):
        to(np.full(3, np.nan), demonstrations[0])


@pytest.mark.data
def test_averaging_leaves_most_of_the_error_as_the_thesis_measured(recordings, refinements):
    model = ConditionedProMP.fit(recordings("dishwasher_experiment")[:2])
    left = [_gap(model.updated(first), first) / _gap(model, first) for first, *_ in refinements]
    assert np.median(left) == pytest.approx(0.61, abs=0.02)


def _gap(model, demonstration):
    predicted = model.predict(demonstration.situation).trajectory
    return np.sqrt(np.mean(np.sum((predicted.positions - demonstration.trajectory.positions) ** 2, axis=1)))


@pytest.mark.parametrize("alpha", [0.0, 0.4])
def test_a_correction_counts_as_far_as_it_is_believed(demonstrations, reach, alpha):
    """Equation (18): what is learnt is the prediction moved by alpha towards the refinement."""
    model = ConditionedProMP.fit(demonstrations)
    correction = reach([0.9, 0.1, 0.6], bend=0.2, duration=9.0)
    refined = refine(model.predict(correction.situation).trajectory, correction.trajectory, alpha, 60)
    expected = model.updated(replace(correction, trajectory=refined))
    learnt = model.updated(replace(correction, provenance=Provenance(confidence=alpha)))
    np.testing.assert_allclose(learnt.joint.mean, expected.joint.mean, atol=1e-12)
