import numpy as np
import pytest

from lfd.exceptions import (
    InvalidDuration,
    LfdError,
    NotFinite,
    NotUnitQuaternion,
    TooFewPoints,
    WrongShape,
)
from lfd.motion.trajectory import Trajectory, equal_phases

POSITIONS = np.arange(12.0).reshape(4, 3)
ORIENTATIONS = np.tile([1.0, 0.0, 0.0, 0.0], (4, 1))


def test_times_are_uniform_from_zero_to_the_duration():
    trajectory = Trajectory(POSITIONS, ORIENTATIONS, 6.0)
    assert trajectory.n_points == 4
    np.testing.assert_allclose(trajectory.times, [0.0, 2.0, 4.0, 6.0])


def test_arrays_are_copied_in_and_read_only_out():
    positions = POSITIONS.copy()
    trajectory = Trajectory(positions, ORIENTATIONS, 1.0)
    positions[:] = 7.0
    np.testing.assert_array_equal(trajectory.positions, POSITIONS)
    for array in (trajectory.positions, trajectory.orientations):
        with pytest.raises(ValueError, match="read-only"):
            array[0, 0] = 1.0


def test_positions_may_be_as_large_as_numbers_are():
    positions = np.full((2, 3), 1e300)
    np.testing.assert_array_equal(Trajectory(positions, [[1.0, 0.0, 0.0, 0.0]] * 2, 1.0).positions, positions)


def test_nobody_can_change_the_phases_of_other_motions():
    np.testing.assert_allclose(equal_phases(5), [0.0, 0.25, 0.5, 0.75, 1.0])
    assert not equal_phases(5).flags.writeable


def test_orientations_become_sign_continuous():
    flipped = ORIENTATIONS * np.array([[1.0], [-1.0], [1.0], [-1.0]])
    np.testing.assert_array_equal(Trajectory(POSITIONS, flipped, 1.0).orientations, ORIENTATIONS)


@pytest.mark.parametrize(
    ("positions", "orientations", "duration", "error", "fact"),
    [
        (POSITIONS[:, :2], ORIENTATIONS, 1.0, WrongShape, ("name", "positions")),
        (POSITIONS, ORIENTATIONS[:3], 1.0, WrongShape, ("actual", (3, 4))),
        (POSITIONS[:1], ORIENTATIONS[:1], 1.0, TooFewPoints, ("count", 1)),
        (np.where(POSITIONS == 7.0, np.nan, POSITIONS), ORIENTATIONS, 1.0, NotFinite, ("index", (2, 1))),
        (POSITIONS, ORIENTATIONS * 1.1, 1.0, NotUnitQuaternion, ("index", 0)),
        (POSITIONS, ORIENTATIONS, 0.0, InvalidDuration, ("duration", 0.0)),
        (POSITIONS, ORIENTATIONS, float("nan"), NotFinite, ("name", "duration")),
    ],
)
def test_what_is_no_trajectory_is_refused_with_the_fact(positions, orientations, duration, error, fact):
    with pytest.raises(error) as caught:
        Trajectory(positions, orientations, duration)
    assert getattr(caught.value, fact[0]) == fact[1]
    assert isinstance(caught.value, LfdError)
    assert "\n" not in str(caught.value)
