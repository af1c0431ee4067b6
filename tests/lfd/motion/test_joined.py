"""A part of a correction and the rest of the prediction, joined."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lfd.exceptions import EmptyPart, OutOfRange
from lfd.motion.refinement import BLEND, joined
from lfd.motion.resampling import at_phases
from lfd.motion.rotations import conjugate, exp_map, log_map, multiply
from lfd.motion.trajectory import Trajectory

N = 101


def motion(bend=0.0, turn=0.0, duration=4.0, n=N):
    phases = np.linspace(0.0, 1.0, n)
    positions = np.column_stack([phases, bend * np.sin(np.pi * phases), 0.2 * phases**2])
    rotations = np.column_stack([turn * phases, 0.3 * phases, np.zeros(n)])
    return Trajectory(positions, exp_map(rotations), duration)


parts = st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)).filter(lambda part: part[1] - part[0] > 0.02)


@given(part=parts)
@settings(max_examples=12)
def test_inside_it_is_the_correction_and_beyond_the_joints_the_prediction(part):
    """At one duration phases are times, and the three motions have the same ones."""
    prediction, correction = motion(), motion(bend=0.3, turn=0.8)
    whole = joined(prediction, correction, part)
    inside = (whole.phases >= part[0]) & (whole.phases <= part[1])
    beyond = (whole.phases < part[0] - BLEND) | (whole.phases > part[1] + BLEND)
    for pose in ("positions", "orientations"):
        result = getattr(whole, pose)
        np.testing.assert_allclose(result[inside], getattr(correction, pose)[inside], atol=1e-12)
        np.testing.assert_allclose(result[beyond], getattr(prediction, pose)[beyond], atol=1e-12)
    assert whole.duration == pytest.approx(4.0)


@given(part=parts)
@settings(max_examples=12)
def test_what_the_correction_says_outside_its_part_does_not_count(part):
    prediction, correction = motion(), motion(bend=0.3, turn=0.8)
    phases = correction.phases
    outside = (phases < part[0] - 1.0 / (N - 1)) | (phases > part[1] + 1.0 / (N - 1))
    elsewhere = np.where(outside[:, None], 7.0, correction.positions)
    turned = np.where(outside[:, None], exp_map(np.array([0.0, 0.0, 2.0])), correction.orientations)
    other = Trajectory(elsewhere, turned, correction.duration)
    one, two = joined(prediction, correction, part), joined(prediction, other, part)
    np.testing.assert_allclose(two.positions, one.positions, atol=1e-12)
    angles = np.linalg.norm(log_map(multiply(conjugate(one.orientations), two.orientations)), axis=1)
    np.testing.assert_allclose(angles, 0.0, atol=1e-7)


@pytest.mark.parametrize("durations", [(4.0, 4.0), (3.0, 6.0)])
@pytest.mark.parametrize("part", [(0.0, 0.6), (0.3, 0.7), (0.4, 1.0)])
def test_the_velocity_does_not_jump(part, durations):
    """C1: the greatest change of velocity between neighbouring points goes to nothing with the spacing."""

    def jump(n):
        whole = joined(motion(duration=durations[0], n=n), motion(0.3, 0.8, durations[1], n), part)
        velocity = np.diff(whole.positions, axis=0) / (whole.duration / (n - 1))
        return float(np.linalg.norm(np.diff(velocity, axis=0), axis=1).max())

    assert jump(4001) < 0.15 * jump(401)


def test_each_part_of_the_motion_keeps_its_own_tempo():
    """The time up to each phase: the prediction's pace before and after, the correction's inside."""
    slow = motion(duration=10.0)
    whole = joined(motion(duration=4.0), slow, (0.4, 0.6))
    joints = BLEND / 2 + BLEND / 2  # each counts for half of its length
    assert whole.duration == pytest.approx(4.0 + 6.0 * (0.2 + joints))
    velocity = np.diff(whole.positions[:, 0]) / (whole.duration / (whole.n_points - 1))
    assert velocity[0] == pytest.approx(1.0 / 4.0, rel=1e-6)
    assert velocity[-1] == pytest.approx(1.0 / 4.0, rel=1e-6)
    middle = np.argmin(np.abs(whole.positions[:, 0] - 0.5))
    assert velocity[middle] == pytest.approx(1.0 / 10.0, rel=1e-6)


def test_a_whole_part_is_the_correction_itself():
    correction = motion(bend=0.3, duration=7.0)
    assert joined(motion(), correction, (0.0, 1.0)) is correction


def test_a_prediction_that_is_joined_to_itself_stays():
    prediction = motion(bend=0.2, turn=0.5)
    whole = joined(prediction, prediction, (0.2, 0.5))
    np.testing.assert_allclose(whole.positions, prediction.positions, atol=1e-12)
    np.testing.assert_allclose(whole.orientations, prediction.orientations, atol=1e-12)


@pytest.mark.parametrize("part", [(0.0, 0.5), (0.5, 1.0)])
def test_the_ends_that_are_not_in_the_part_are_as_predicted(part):
    whole = joined(motion(), motion(bend=0.3), part)
    np.testing.assert_allclose(whole.positions[[0, -1]], motion().positions[[0, -1]], atol=1e-12)


def test_motions_of_different_numbers_of_points_give_the_greater():
    whole = joined(motion(n=75), motion(bend=0.3, n=140), (0.2, 0.8))
    assert whole.n_points == 140
    expected = at_phases(motion(bend=0.3, n=140), whole.phases).positions
    inside = (whole.phases >= 0.2) & (whole.phases <= 0.8)
    np.testing.assert_allclose(whole.positions[inside], expected[inside], atol=1e-12)


@pytest.mark.parametrize("part", [(0.5, 0.5), (0.6, 0.4)])
def test_an_empty_part_is_refused(part):
    with pytest.raises(EmptyPart, match="is empty") as caught:
        joined(motion(), motion(), part)
    assert (caught.value.first, caught.value.last) == part


@pytest.mark.parametrize("part", [(-0.1, 0.5), (0.5, 1.1), (float("nan"), 0.5)])
def test_a_phase_outside_the_motion_is_refused(part):
    with pytest.raises(OutOfRange, match="phase"):
        joined(motion(), motion(), part)


@pytest.mark.parametrize("blend", [0.0, -1.0, 2.0])
def test_a_blend_that_is_no_share_is_refused(blend):
    with pytest.raises(OutOfRange, match="blend"):
        joined(motion(), motion(), (0.2, 0.5), blend)
