import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lfd.exceptions import OutOfRange, UnreachableViaPoint, WrongShape
from lfd.models.adaptive.adaptation import AdaptiveProMP
from lfd.models.distribution import blend
from lfd.models.promp import ConditionedProMP
from lfd.models.via_point import SWING, ViaPoint
from lfd.motion.rotations import conjugate, log_map, multiply

PLACES = [[0.9, 0.3, 0.6], [0.85, 0.05, 0.62], [0.92, -0.3, 0.58], [0.8, -0.1, 0.65]]


@pytest.fixture(params=[AdaptiveProMP, ConditionedProMP], ids=["default", "thesis"])
def distribution(request, reach):
    model = request.param.fit([reach(place, bend=0.05 * i, duration=4.0 + i) for i, place in enumerate(PLACES)])
    return model.distribution(reach([0.9, 0.1, 0.6]).situation)


def exactly(phase, position):
    return ViaPoint(phase, np.array(position), np.zeros((3, 3)))


def test_velocities_are_the_derivative_of_the_motion(distribution):
    n = 4001
    motion, (linear, angular) = distribution.trajectory(n), distribution.velocities(n)
    dt = motion.duration / (n - 1)
    np.testing.assert_allclose(linear[1:-1], (motion.positions[2:] - motion.positions[:-2]) / (2 * dt), atol=1e-4)
    turns = log_map(multiply(motion.orientations[2:], conjugate(motion.orientations[:-2])))
    np.testing.assert_allclose(angular[1:-1], turns / (2 * dt), atol=1e-4)


def test_samples_have_the_mean_and_the_spread_of_the_distribution(distribution):
    rng = np.random.default_rng(7)
    positions = np.array([motion.positions for motion in distribution.sample(rng, 3000, 20)])
    covariances = distribution.position_covariances(20) - distribution.noise_std**2 * np.eye(3)
    scale = np.sqrt(np.abs(covariances).max())
    np.testing.assert_allclose(positions.mean(axis=0), distribution.trajectory(20).positions, atol=0.06 * scale)
    deviations = positions - positions.mean(axis=0)
    sampled = np.einsum("sti,stj->tij", deviations, deviations) / len(positions)
    np.testing.assert_allclose(sampled, covariances, atol=0.08 * scale**2)


def test_the_same_seed_gives_the_same_samples(distribution):
    first, second = (distribution.sample(np.random.default_rng(3), 2, 30) for _ in range(2))
    np.testing.assert_array_equal(first[1].positions, second[1].positions)


def test_an_exact_via_point_is_passed_and_known_for_sure(distribution):
    place = distribution.trajectory(75).positions[37] + [0.02, -0.03, 0.01]
    led = distribution.through(exactly(0.5, place))
    np.testing.assert_allclose(led.trajectory(75).positions[37], place, atol=1e-6)
    own = led.position_covariances(75)[37] - distribution.noise_std**2 * np.eye(3)
    assert np.abs(own).max() < 1e-6 * np.abs(distribution.position_covariances(75)[37]).max()


def test_a_vague_via_point_draws_the_motion_as_a_product_of_gaussians_does(distribution):
    """At the via-point's own time the mean lies where the two Gaussians' precisions put it."""
    prior, covariance = distribution.trajectory(75).positions[30], np.diag([1e-4, 4e-4, 1e-3])
    own = distribution.position_covariances(75)[30] - distribution.noise_std**2 * np.eye(3)
    place = prior + np.array([0.03, 0.02, -0.02])
    led = distribution.through(ViaPoint(30 / 74, place, covariance))
    gain = own @ np.linalg.inv(own + covariance)
    np.testing.assert_allclose(led.trajectory(75).positions[30], prior + gain @ (place - prior), atol=1e-6)
    remaining = led.position_covariances(75)[30] - distribution.noise_std**2 * np.eye(3)
    np.testing.assert_allclose(remaining, own - gain @ own, atol=1e-8)


def test_the_order_of_via_points_does_not_matter(distribution):
    """Of those that the motion is led through as the covariance carries them on."""
    vague, path = 1e-4 * np.eye(3), distribution.trajectory(11).positions
    first, second = ViaPoint(0.4, path[4] + 0.004, vague), ViaPoint(0.7, path[7] - 0.004, vague)
    there, back = distribution.through(first).through(second), distribution.through(second).through(first)
    np.testing.assert_allclose(there.trajectory(50).positions, back.trajectory(50).positions, atol=1e-7)


def test_the_start_of_an_anchored_motion_cannot_be_moved(reach):
    model = AdaptiveProMP.fit([reach(place) for place in PLACES])
    distribution = model.distribution(reach(PLACES[0]).situation)
    start = distribution.trajectory(20).positions[0]
    with pytest.raises(UnreachableViaPoint, match="the motion is fixed there") as caught:
        distribution.through(exactly(0.0, start + np.array([0.0, 0.03, 0.04])))
    assert (caught.value.phase, caught.value.offset, caught.value.swing) == (0.0, pytest.approx(0.05), np.inf)
    led = distribution.through(exactly(0.0, start))
    np.testing.assert_allclose(led.trajectory(20).positions, distribution.trajectory(20).positions, atol=1e-9)


def test_the_start_of_a_motion_that_is_not_anchored_is_moved(reach):
    distribution = ConditionedProMP.fit([reach(place) for place in PLACES]).distribution(reach(PLACES[0]).situation)
    place = distribution.trajectory(20).positions[0] + [0.0, 0.03, 0.04]
    np.testing.assert_allclose(distribution.through(exactly(0.0, place)).trajectory(20).positions[0], place, atol=1e-4)


def test_a_via_point_just_after_a_given_start_swings_nothing(reach):
    """One 5 cm aside at phase 0.002 swung the motion by 5.4 m."""
    distribution = AdaptiveProMP.fit([reach(PLACES[0])]).distribution(reach(PLACES[0]).situation)
    with pytest.raises(UnreachableViaPoint, match="farther from the start") as caught:
        distribution.through(exactly(0.002, distribution.trajectory(501).positions[1] + [0.0, 0.05, 0.0]))
    assert 0.05 * SWING < caught.value.swing < np.inf


@pytest.fixture(scope="module")
def taught(reach):
    """Distributions of both models, of one demonstration and of several."""
    motions = [reach(place, bend=0.05 * i, duration=4.0 + i) for i, place in enumerate(PLACES)]
    wanted = reach([0.9, 0.1, 0.6]).situation
    return [kind.fit(motions[:m]).distribution(wanted) for kind in (AdaptiveProMP, ConditionedProMP) for m in (1, 2, 4)]


@given(
    which=st.integers(0, 5),
    phase=st.floats(0.0, 1.0) | st.floats(0.0, 0.05),
    offset=st.tuples(*[st.floats(-0.3, 0.3)] * 3),
    stds=st.tuples(*[st.sampled_from([0.0, 1e-4, 1e-3, 1e-2, 0.1])] * 3),
)
@settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_a_via_point_is_met_without_swinging_the_motion_or_refused_near_a_given_start(
    taught, which, phase, offset, stds
):
    """It is met to within three of its own standard deviations, and nothing moves by more than 1.25 times as far."""
    distribution, covariance = taught[which], np.diag(np.square(stds))
    before = distribution.encoding.outputs(distribution.mean, distribution.situation, np.array([phase]))[0, :3]
    away = float(np.linalg.norm(offset))
    via = ViaPoint(phase, before + offset + distribution.situation.origin, covariance)
    try:
        led = distribution.through(via)
    except UnreachableViaPoint:
        assert distribution.encoding.anchored
        assert phase < 0.01
        return
    moved = led.trajectory(501).positions - distribution.trajectory(501).positions
    assert np.linalg.norm(moved, axis=1).max() <= 1.01 * SWING * away + 1e-9
    at = led.encoding.outputs(led.mean, led.situation, np.array([phase]))[0, :3]
    missed, deviation = before + offset - at, covariance + (1e-3 * away + 1e-9) ** 2 * np.eye(3)
    assert missed @ np.linalg.solve(deviation, missed) <= 3.0**2
    assert np.linalg.eigvalsh(led.position_covariances(25)).min() > -1e-12


@given(
    which=st.integers(0, 5),
    phases=st.tuples(st.floats(0.05, 1.0), st.floats(0.05, 1.0)),
    offsets=st.tuples(*[st.tuples(*[st.floats(-0.1, 0.1)] * 3)] * 2),
)
@settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_a_later_via_point_leads_away_from_no_earlier_one(taught, which, phases, offsets):
    led = taught[which]
    path = led.encoding.outputs(led.mean, led.situation, np.array(phases))[:, :3] + led.situation.origin
    places = path + np.array(offsets)
    led = led.through(exactly(phases[0], places[0]))
    try:
        led = led.through(exactly(phases[1], places[1]))
    except UnreachableViaPoint:
        assert abs(phases[0] - phases[1]) < 0.1
    at = led.encoding.outputs(led.mean, led.situation, np.array(phases))[:, :3] + led.situation.origin
    count = len(led.via_points)
    np.testing.assert_allclose(at[:count], places[:count], atol=3e-4)


def test_two_via_points_at_one_time_contradict_each_other(taught):
    here = taught[0].trajectory(3).positions[1]
    led = taught[0].through(exactly(0.5, here))
    with pytest.raises(UnreachableViaPoint, match="other via-points"):
        led.through(exactly(0.5, here + np.array([0.0, 0.05, 0.0])))
    vague = ViaPoint(0.5, here + np.array([0.0, 0.05, 0.0]), 0.1**2 * np.eye(3))
    np.testing.assert_allclose(led.through(vague).trajectory(3).positions[1], here, atol=1e-6)


@given(phase=st.floats(0.01, 1.0), seed=st.integers(0, 2**32 - 1))
@settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_covariances_stay_positive_whatever_the_via_point(distribution, phase, seed):
    rng = np.random.default_rng(seed)
    led = distribution.through(ViaPoint(phase, rng.normal(size=3), np.diag(rng.choice([0.0, 1e-6, 1.0], size=3))))
    assert np.linalg.eigvalsh(led.position_covariances(25)).min() > -1e-12


@pytest.mark.parametrize("share", [0.0, 1.0])
def test_a_blend_is_at_its_ends_the_one_motion_or_the_other(reach, share):
    a, b = two(reach)
    motion, covariances = blend(a, b, np.full(40, share))
    alone = (a, b)[int(share)]
    np.testing.assert_allclose(motion.positions, alone.trajectory(40).positions, atol=1e-9)
    np.testing.assert_allclose(covariances, alone.position_covariances(40), atol=1e-9)
    assert motion.duration == pytest.approx(alone.trajectory(40).duration)
    same = np.abs(np.sum(motion.orientations * alone.trajectory(40).orientations, axis=1))
    np.testing.assert_allclose(same, 1.0, atol=1e-9)


def test_a_blend_trusts_the_surer_motion_more(reach):
    a, b = two(reach)
    sure = a.through(exactly(0.5, a.trajectory(3).positions[1]))
    motion, _ = blend(sure, b, np.full(3, 0.5))
    np.testing.assert_allclose(motion.positions[1], a.trajectory(3).positions[1], atol=1e-4)


def test_what_makes_no_sense_is_refused(reach):
    a, b = two(reach)
    with pytest.raises(OutOfRange, match="phase"):
        exactly(1.1, [0.0, 0.0, 0.0])
    with pytest.raises(OutOfRange, match="eigenvalue"):
        ViaPoint(0.5, np.zeros(3), -np.eye(3))
    with pytest.raises(OutOfRange, match="share"):
        blend(a, b, np.array([0.0, 1.5]))
    with pytest.raises(WrongShape):
        blend(a, b, np.zeros((2, 2)))


def two(reach):
    left = AdaptiveProMP.fit([reach(place, bend=0.2) for place in PLACES])
    right = AdaptiveProMP.fit([reach(place, bend=-0.2, duration=8.0) for place in PLACES])
    situation = reach(PLACES[1]).situation
    return left.distribution(situation), right.distribution(situation)
