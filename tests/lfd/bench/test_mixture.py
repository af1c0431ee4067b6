"""Gaussian mixtures, their regression, and what is made of them, by closed forms."""

from dataclasses import replace

import numpy as np
import pytest

from lfd.motion.demonstration import Demonstration, Situation
from tests.bench.baselines.anchored import AnchoredMean
from tests.bench.baselines.kmp import KMP, KmpOptions
from tests.bench.baselines.mixture import Mixture, regress
from tests.bench.baselines.tpgmm import TPGMM

PLACES = ([0.9, 0.3, 0.6], [0.9, 0.0, 0.6], [0.9, -0.3, 0.6])


@pytest.fixture(scope="module")
def demonstrations(reach):
    return [reach(place, bend=bend) for place, bend in zip(PLACES, (0.0, 0.1, 0.05), strict=True)]


def test_one_component_is_the_gaussian_of_the_points(rng):
    points = np.column_stack([np.linspace(0.0, 1.0, 50), rng.normal(size=(50, 2))])
    mixture = Mixture.fit(points[None], 1, np.zeros(3))
    assert mixture.means[0, 0] == pytest.approx(points.mean(axis=0))
    assert mixture.covariances[0, 0] == pytest.approx(np.cov(points.T, bias=True))


def test_components_far_apart_are_found(rng):
    t = np.linspace(0.0, 1.0, 200)
    clusters = np.where(t < 0.3, -1.0, 1.0)  # equal slices of time cut one of them
    points = np.column_stack([t, clusters + 0.01 * rng.normal(size=200)])
    mixture = Mixture.fit(points[None], 2, np.full(2, 1e-6))
    assert sorted(mixture.priors) == pytest.approx([0.3, 0.7], abs=0.02)
    assert sorted(mixture.means[0, :, 1]) == pytest.approx([-1.0, 1.0], abs=0.01)


def test_regression_on_one_component_is_linear_regression(rng):
    x = rng.normal(size=(80, 1))
    y = x * [2.0, -1.0] + 0.1 * rng.normal(size=(80, 2))
    joint = np.hstack([x, y])
    mean, covariance = joint.mean(axis=0), np.cov(joint.T, bias=True)
    wanted = regress(np.ones(1), mean[None], covariance[None], np.array([[0.3], [-2.0]]))
    slope, offset = np.linalg.lstsq(np.hstack([x, np.ones((80, 1))]), y, rcond=None)[0]
    assert wanted.means == pytest.approx(np.array([[0.3], [-2.0]]) * slope + offset)
    left = np.cov((y - x * slope - offset).T, bias=True)
    assert wanted.covariances[0] == pytest.approx(left)


def test_regression_between_components_adds_their_disagreement():
    means = np.array([[0.0, -1.0], [0.0, 1.0]])
    wanted = regress(np.array([0.5, 0.5]), means, np.tile(np.diag([1.0, 0.04]), (2, 1, 1)), np.zeros((1, 1)))
    assert wanted.means == pytest.approx(0.0)
    assert wanted.covariances == pytest.approx(1.04)


def test_a_kernelised_primitive_follows_its_reference_where_nothing_is_regularised(demonstrations):
    model = KMP.fit(demonstrations, KmpOptions(mean_regularisation=1e-4))
    reference = model.reference
    means, _ = model.regress(reference.phases, reference.conditions)
    assert means == pytest.approx(reference.means, abs=1e-3)


def test_a_kernelised_primitive_expects_the_mean_motion_far_away(demonstrations, reach):
    model, far = KMP.fit(demonstrations), reach([100.0, 0.0, 0.6]).situation
    prediction, mean = model.predict(far, 30), AnchoredMean.fit(demonstrations).predict(far, 30)
    assert prediction.trajectory.positions == pytest.approx(mean.trajectory.positions, abs=1e-9)
    widest = len(model.reference.phases) / model.options.covariance_regularisation
    assert prediction.position_covariances == pytest.approx(np.tile(widest * np.eye(3), (30, 1, 1)))


def test_a_correction_replaces_the_reference_at_its_condition(demonstrations, reach):
    model = KMP.fit(demonstrations)
    correction = reach(PLACES[0], bend=0.2)
    taught = model.updated(correction)
    assert len(taught.reference.phases) == len(model.reference.phases)
    positions = taught.predict(correction.situation, 60).trajectory.positions
    assert positions == pytest.approx(correction.trajectory.positions, abs=0.02)


def test_a_task_parameterised_mixture_moves_with_its_frames(demonstrations):
    shift = np.array([0.3, -2.0, 1.0])
    situation = demonstrations[1].situation
    moved = Situation(
        situation.condition, situation.origin + shift, situation.start_position + shift, situation.start_orientation
    )
    elsewhere = [_shifted(d, shift) for d in demonstrations]
    model = TPGMM.fit(demonstrations)
    plain = model.predict(situation, 40)
    for prediction in (model.predict(moved, 40), TPGMM.fit(elsewhere).predict(moved, 40)):
        assert prediction.trajectory.positions == pytest.approx(plain.trajectory.positions + shift, abs=1e-9)
        assert prediction.position_covariances == pytest.approx(plain.position_covariances, abs=1e-9)


def test_a_task_parameterised_mixture_ends_at_the_object_where_all_motions_do(reach):
    model = TPGMM.fit([reach(place) for place in PLACES])
    new = reach([0.9, 0.15, 0.6]).situation
    path = model.predict(new, 100).trajectory.positions
    assert path[-1] == pytest.approx(new.origin, abs=0.03)
    assert path[0] == pytest.approx(new.start_position, abs=0.03)


def _shifted(demonstration, shift):
    trajectory = replace(demonstration.trajectory, positions=demonstration.trajectory.positions + shift)
    return Demonstration.reaching(trajectory, demonstration.origin + shift)
