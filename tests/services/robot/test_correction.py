import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.motion.rotations import exp_map, multiply
from services.robot.correction import UNCORRECTED, Correction
from sim.pose import Pose

vectors = st.tuples(*[st.floats(-1.7, 1.7)] * 3).map(np.array)


def pose(orientation):
    return Pose(np.array([0.5, 0.1, 0.8]), exp_map(orientation))


@given(vectors, vectors, vectors)
def test_a_corrected_pose_is_moved_and_then_rotated_in_base_axes(offset, turn, orientation):
    corrected = Correction(offset, turn).of(pose(orientation))
    np.testing.assert_array_equal(corrected.position, pose(orientation).position + offset)
    np.testing.assert_allclose(
        corrected.orientation, multiply(exp_map(turn), pose(orientation).orientation), atol=1e-15, rtol=1e-14
    )


@pytest.mark.parametrize("size", [1e-320, 1e-200, 1e-12, 1e-8])
def test_the_smallest_turn_is_no_special_case(size):
    corrected = Correction(np.zeros(3), np.array([size, 0.0, -size])).of(pose(np.array([0.3, 0.0, 0.2])))
    assert np.linalg.norm(corrected.orientation) == pytest.approx(1.0, abs=1e-15)
    np.testing.assert_allclose(corrected.orientation, pose(np.array([0.3, 0.0, 0.2])).orientation, atol=1e-8)


@given(vectors)
def test_no_correction_leaves_a_pose_as_it_is(orientation):
    corrected, before = UNCORRECTED.of(pose(orientation)), pose(orientation)
    assert corrected.position.tobytes() == before.position.tobytes()
    assert corrected.orientation.tobytes() == before.orientation.tobytes()


@given(vectors, vectors, st.floats(0.0, 1.0))
def test_a_share_of_the_way_lies_on_the_line_between(offset, turn, share):
    wanted = Correction(offset, turn)
    moved = UNCORRECTED.towards(wanted, share)
    np.testing.assert_allclose(moved.offset, share * offset, atol=1e-15)
    np.testing.assert_allclose(moved.turn, share * turn, atol=1e-15)
