"""The Gaussian process among the baselines, by closed forms."""

from dataclasses import replace

import numpy as np
import pytest

from tests.bench.baselines.anchored import Examples
from tests.bench.baselines.gaussian_process import GaussianProcess, kernel


@pytest.fixture
def examples(reach):
    places = ([0.9, 0.3, 0.6], [0.9, 0.0, 0.7], [0.8, -0.3, 0.6], [0.7, 0.1, 0.5])
    return Examples.of([reach(place, bend=bend) for place, bend in zip(places, (0.0, 0.1, 0.05, -0.1), strict=True)])


@pytest.fixture
def process(examples):
    return GaussianProcess(examples, np.array([0.3, 0.4, 0.5]), 1e-12)


def test_without_noise_it_passes_through_what_was_shown(process, reach):
    shown = reach([0.9, 0.0, 0.7], bend=0.1)
    prediction = process.predict(shown.situation, 60)
    assert prediction.trajectory.positions == pytest.approx(shown.trajectory.positions, abs=1e-3)
    assert prediction.position_covariances == pytest.approx(0.0, abs=1e-9)


def test_far_away_it_expects_the_mean_by_generalised_least_squares(process, reach):
    far = reach([50.0, 0.0, 0.6]).situation
    S, X = process.examples.conditions, process.examples.vectors
    weights = np.linalg.solve(kernel(S, S, process.lengths), np.ones(len(S)))
    expected = process.examples.encoding.decode(weights @ X / weights.sum(), far, 60)
    assert process.predict(far, 60).trajectory.positions == pytest.approx(expected.positions, abs=1e-6)


def test_the_likelihood_is_the_restricted_one_of_a_gaussian(process, rng):
    """Of departures from the mean: ln |C| of their covariance C and their squares, over all M - 1 contrasts."""
    noisy = replace(process, noise=0.3)
    y = rng.normal(size=(4, 1))
    contrasts = np.linalg.svd(np.ones((1, 4)))[2][1:]
    S = noisy.examples.conditions
    C = contrasts @ (kernel(S, S, noisy.lengths) + 0.3 * np.eye(4)) @ contrasts.T
    z = contrasts @ y
    size = (z.T @ np.linalg.solve(C, z)).item() / 3.0
    expected = 0.5 * (np.linalg.slogdet(C)[1] + 3.0 * np.log(size) + np.log(4.0))
    assert noisy.negative_log_likelihood(y) == pytest.approx(expected)


def test_units_of_a_dimension_change_nothing(reach):
    demonstrations = [reach([0.9, y, 0.6 + 0.1 * y * y], bend=y) for y in (-0.3, -0.1, 0.1, 0.2)]
    factors = np.array([1.0, 100.0, 0.01])
    rescaled = [replace(d, condition=d.condition * factors) for d in demonstrations]
    wanted = reach([0.9, 0.0, 0.6])
    other = replace(wanted, condition=wanted.condition * factors)
    plain = GaussianProcess.fit(demonstrations).predict(wanted.situation, 30)
    scaled = GaussianProcess.fit(rescaled).predict(other.situation, 30)
    assert scaled.trajectory.positions == pytest.approx(plain.trajectory.positions, abs=1e-6)


def test_a_dimension_that_says_nothing_gets_the_longer_length(reach, rng):
    demonstrations = []
    for y in np.linspace(-0.3, 0.3, 9):
        motion = reach([0.9, y, 0.6], bend=np.sin(8.0 * y))
        demonstrations.append(replace(motion, condition=np.array([y, 0.2 * rng.normal()])))
    process = GaussianProcess.fit(demonstrations)
    telling, idle = process.lengths / process.examples.conditions.std(axis=0)
    assert idle > 2.0 * telling
