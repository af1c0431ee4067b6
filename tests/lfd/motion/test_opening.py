"""How far the gripper is open: an output of motions beside their poses."""

from dataclasses import replace

import numpy as np
import pytest

from lfd.exceptions import NotFinite, OpeningMismatch, OutOfRange, WrongShape
from lfd.motion.alignment import align
from lfd.motion.demonstration import Demonstration, relative_to_origin, to_base
from lfd.motion.refinement import joined, refine
from lfd.motion.resampling import Interpolation, along_the_way, from_samples, resample
from lfd.motion.trajectory import Trajectory

OPEN = 0.08
N = 101


def closing(at, duration=5.0, n=N):
    """A straight reach that closes the gripper at a phase."""
    phases = np.linspace(0.0, 1.0, n)
    positions = np.outer(phases, [0.6, 0.1, -0.2])
    opening = np.where(phases < at, OPEN, 0.0)
    return Trajectory(positions, np.tile([1.0, 0.0, 0.0, 0.0], (n, 1)), duration, opening)


def closed_at(motion):
    """The first phase at which the gripper is more closed than open."""
    return motion.phases[np.argmax(motion.opening < OPEN / 2)]


def without(motion):
    return Trajectory(motion.positions, motion.orientations, motion.duration)


@pytest.mark.parametrize(
    ("opening", "error"),
    [
        (np.zeros(N - 1), WrongShape),
        (np.zeros((N, 1)), WrongShape),
        (np.full(N, np.nan), NotFinite),
        (np.where(np.arange(N) == 3, -0.001, 0.01), OutOfRange),
    ],
)
def test_what_is_no_opening_is_refused(opening, error):
    plain = closing(0.5)
    with pytest.raises(error):
        Trajectory(plain.positions, plain.orientations, 1.0, opening)


def test_an_opening_is_copied_in_and_read_only_out():
    given = np.zeros(N)
    motion = Trajectory(closing(0.5).positions, closing(0.5).orientations, 1.0, given)
    given[:] = 1.0
    np.testing.assert_array_equal(motion.opening, 0.0)
    assert not motion.opening.flags.writeable


@pytest.mark.parametrize("interpolation", Interpolation)
def test_resampled_it_stays_between_what_it_was_and_steps_within_a_sample(interpolation):
    fine = resample(closing(0.5), 1000, interpolation)
    assert fine.opening.min() == 0.0
    assert fine.opening.max() == OPEN
    turning = fine.phases[(fine.opening > 0.0) & (fine.opening < OPEN)]
    assert np.all(np.abs(turning - 0.495) < 0.005)


def test_samples_at_irregular_times_keep_it():
    times = np.linspace(0.0, 1.0, N) ** 2
    motion = from_samples(times, closing(0.5).positions, closing(0.5).orientations, 1000, closing(0.5).opening)
    assert closed_at(motion) == pytest.approx(0.25, abs=0.01)


def test_a_motion_that_stands_while_it_closes_still_stands_along_its_way():
    way = np.concatenate([np.linspace(0.0, 0.3, 40), np.full(60, 0.3), np.linspace(0.3, 0.5, 40)])
    opening = np.concatenate([np.full(60, OPEN), np.linspace(OPEN, 0.0, 20), np.zeros(60)])
    stands = Trajectory(np.outer(way, [1.0, 0.0, 0.0]), np.tile([1.0, 0, 0, 0], (140, 1)), 14.0, opening)
    motion = along_the_way(stands, 75)
    closes = (motion.opening > 0.002) & (motion.opening < OPEN - 0.002)
    assert np.count_nonzero(closes) * 14.0 / 75 > 1.0
    assert np.ptp(motion.positions[closes, 0]) < 0.01


def test_it_is_the_same_relative_to_an_origin_and_back():
    origin = np.array([0.5, 0.0, 0.2])
    there = relative_to_origin(closing(0.5), origin)
    np.testing.assert_array_equal(there.opening, closing(0.5).opening)
    np.testing.assert_array_equal(to_base(there, origin).opening, closing(0.5).opening)


def test_a_refinement_closes_when_the_human_did_and_in_part_between():
    assert closed_at(refine(closing(0.8), closing(0.6), 0.0)) == pytest.approx(0.8, abs=0.02)
    assert closed_at(refine(closing(0.8), closing(0.6), 1.0)) == pytest.approx(0.6, abs=0.02)
    assert 0.62 < closed_at(refine(closing(0.8), closing(0.6), 0.5)) < 0.78


@pytest.mark.parametrize("combine", [refine, lambda a, b: joined(a, b, (0.2, 0.6))])
def test_a_motion_with_and_one_without_an_opening_do_not_go_together(combine):
    with pytest.raises(OpeningMismatch):
        combine(closing(0.5), without(closing(0.5)))
    with pytest.raises(OpeningMismatch):
        combine(without(closing(0.5)), closing(0.5))


@pytest.mark.parametrize(("predicted", "corrected"), [(0.8, 0.5), (0.4, 0.6)])
def test_a_part_in_which_the_gripper_closes_at_another_moment_closes_once(predicted, corrected):
    motion = joined(closing(predicted), closing(corrected), (0.45, 0.7))
    assert closed_at(motion) == pytest.approx(corrected, abs=0.02)
    assert np.all(np.diff(motion.opening) < 1e-12)


def test_a_part_before_the_gripper_closes_leaves_its_moment():
    motion = joined(closing(0.8), closing(0.8, duration=9.0), (0.2, 0.5))
    assert np.all(np.diff(motion.opening) < 1e-12)
    assert closed_at(motion) == pytest.approx(0.8, abs=0.1)  # its tempo changes in the part


def test_demonstrations_that_stand_to_close_are_brought_to_one_moment_of_closing():
    way = np.clip(1.5 * np.linspace(0.0, 1.0, N), 0.0, 0.6)  # stands from phase 0.4 on
    stands = [replace(closing(at), positions=np.outer(way, [1.0, 0.0, 0.0])) for at in (0.6, 0.8, 0.9)]
    aligned = align([Demonstration.reaching(motion, np.array([0.6, 0.0, 0.0])) for motion in stands])
    assert np.ptp([closed_at(one.trajectory) for one in aligned]) < 0.03
