import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.exceptions import NotFinite, OutOfRange, TooFewDemonstrations, WrongShape
from lfd.models.gaussian import JointGaussian, condition, welford

seeds = st.integers(0, 10_000)


@given(seeds, st.integers(1, 8), st.integers(1, 12))
def test_welford_equals_the_batch_fit(seed, first, more):
    samples = np.random.default_rng(seed).normal(size=(first + more, 6))
    joint = JointGaussian.fit(samples[:first])
    for x in samples[first:]:
        joint = welford(joint, x)
    batch = JointGaussian.fit(samples)
    assert joint.count == batch.count
    np.testing.assert_allclose(joint.mean, batch.mean, atol=1e-12)
    np.testing.assert_allclose(joint.covariance, batch.covariance, atol=1e-12)


@given(seeds, st.floats(0.2, 0.99))
def test_forgetting_weighs_every_sample_by_its_age(seed, kept):
    """Against weighted means of all samples, the newest of weight one."""
    samples = np.random.default_rng(seed).normal(size=(7, 4))
    joint = JointGaussian.fit(samples[:1])
    for x in samples[1:]:
        joint = welford(joint, x, kept)
    weights = kept ** np.arange(6.0, -1.0, -1.0)
    mean = weights @ samples / weights.sum()
    np.testing.assert_allclose(joint.mean, mean, atol=1e-12)
    np.testing.assert_allclose(joint.scatter, (samples - mean).T * weights @ (samples - mean), atol=1e-12)
    assert joint.count == pytest.approx(weights.sum())


def test_a_forgetting_factor_outside_its_range_is_refused():
    for kept in (0.0, 1.1, np.nan):
        with pytest.raises(OutOfRange):
            welford(JointGaussian.fit(np.ones((2, 5))), np.ones(5), kept)


@pytest.mark.parametrize("count", [2, 3, 9])
def test_batch_covariance_is_the_unbiased_one(rng, count):
    samples = rng.normal(size=(count, 4))
    np.testing.assert_allclose(JointGaussian.fit(samples).covariance, np.cov(samples.T), atol=1e-14)


def test_conditioning_is_the_closed_form(rng):
    samples = rng.normal(size=(20, 5)) @ rng.normal(size=(5, 5))
    joint, s, noise = JointGaussian.fit(samples), np.array([0.3, -0.2]), 0.03
    Sigma = np.cov(samples.T)
    gain = Sigma[:3, 3:] @ np.linalg.inv(Sigma[3:, 3:] + noise * np.eye(2))
    conditional = condition(joint, s, noise)
    np.testing.assert_allclose(conditional.mean, joint.mean[:3] + gain @ (s - joint.mean[3:]), atol=1e-12)
    np.testing.assert_allclose(conditional.covariance, Sigma[:3, :3] - gain @ Sigma[3:, :3], atol=1e-12)


@given(seeds, st.integers(1, 4), st.floats(1e-12, 1.0))
def test_conditional_covariance_is_positive_semidefinite_however_few_the_samples(seed, count, noise):
    samples = np.random.default_rng(seed).normal(size=(count, 9))
    covariance = condition(JointGaussian.fit(samples), np.zeros(3), noise).covariance
    assert np.linalg.eigvalsh(covariance).min() > -1e-9
    np.testing.assert_array_equal(covariance, covariance.T)


def test_one_sample_predicts_itself_at_any_condition():
    conditional = condition(JointGaussian.fit(np.arange(5.0)[None]), np.array([100.0, -100.0]), 0.03)
    np.testing.assert_allclose(conditional.mean, [0.0, 1.0, 2.0])
    np.testing.assert_allclose(conditional.covariance, 0.0)


def test_linear_dependence_on_the_condition_is_recovered(rng):
    s = rng.normal(size=(30, 2))
    B = rng.normal(size=(2, 3))
    conditional = condition(JointGaussian.fit(np.hstack([s @ B + 1.0, s])), np.array([0.5, 2.0]), 1e-13)
    np.testing.assert_allclose(conditional.mean, np.array([0.5, 2.0]) @ B + 1.0, atol=1e-10)


def test_no_sample_and_no_noise_are_refused():
    with pytest.raises(TooFewDemonstrations):
        JointGaussian.fit(np.empty((0, 5)))
    with pytest.raises(OutOfRange):
        condition(JointGaussian.fit(np.ones((2, 5))), np.zeros(2), 0.0)


def test_what_a_condition_gives_cannot_be_written_to(rng):
    given = condition(JointGaussian.fit(rng.normal(size=(9, 5))), np.zeros(2), 0.1)
    for array in (given.mean, given.covariance):
        assert not array.flags.writeable


def test_a_gaussian_keeps_its_own_numbers_whatever_becomes_of_those_it_was_made_of(rng):
    mean, scatter = rng.normal(size=3), np.eye(3)
    joint = JointGaussian(mean, scatter, 2.0)
    mean[0], scatter[0, 0] = 100.0, 100.0
    assert joint.mean[0] != 100.0
    assert joint.scatter[0, 0] == 1.0
    for array in (joint.mean, joint.scatter, joint.covariance):
        assert not array.flags.writeable


@pytest.mark.parametrize(
    ("mean", "scatter", "error"),
    [
        (np.zeros((3, 1)), np.eye(3), WrongShape),
        (np.zeros(3), np.eye(2), WrongShape),
        (np.array([0.0, np.nan]), np.eye(2), NotFinite),
        (np.zeros(2), np.diag([1.0, np.inf]), NotFinite),
    ],
    ids=["mean of a wrong shape", "scatter of another size", "mean not finite", "scatter not finite"],
)
def test_what_is_no_gaussian_is_refused(mean, scatter, error):
    with pytest.raises(error):
        JointGaussian(mean, scatter, 2.0)
