"""A person who steers stands while the gripper moves."""

import numpy as np
import pytest

from sim.person.steering import steer
from sim.tasks.scene import Corridor

WIDE = 0.1
WAY = np.array([[0.0, 0.0, 0.0], [0.2, 0.1, 0.0], [0.3, 0.1, 0.0], [0.3, 0.1, 0.16]])
TURNS = np.tile([1.0, 0.0, 0.0, 0.0], (4, 1))
PICK = Corridor(WAY, TURNS, np.array([WIDE, WIDE, 0.0, 0.0]))
N = 400


def test_it_closes_where_it_grasps_and_lifts_when_it_has_closed() -> None:
    motion = steer(PICK, None, N)
    assert motion.longer == pytest.approx(1.35)  # 10 s to reach, 1.5 s to grasp, 2 s to lift
    assert set(motion.opening.tolist()) == {WIDE, 0.0}
    standing = np.all(np.abs(motion.positions - WAY[2]) < 1e-3, axis=1)
    closed = motion.opening == 0.0
    assert standing[np.flatnonzero(closed)[0]]
    seconds = 13.5 / (N - 1)
    assert np.count_nonzero(standing & closed) * seconds == pytest.approx(1.5, abs=0.4)
    np.testing.assert_allclose(motion.positions[-1], WAY[-1], atol=1e-9)


def test_a_person_aims_at_what_they_grasp() -> None:
    rng = np.random.default_rng(1)
    for _ in range(5):
        motion = steer(PICK, rng, N)
        closes = np.flatnonzero(motion.opening == 0.0)[0]
        np.testing.assert_allclose(motion.positions[closes], WAY[2], atol=1e-6)


def test_what_is_only_grasped_ends_there() -> None:
    motion = steer(Corridor(WAY[:3], TURNS[:3], np.array([WIDE, WIDE, 0.0])), None, N)
    np.testing.assert_allclose(motion.positions[-1], WAY[2], atol=1e-9)
    assert (motion.opening[0], motion.opening[-1]) == (WIDE, 0.0)


def test_without_a_gripper_nothing_is_said_of_it() -> None:
    assert steer(Corridor(WAY, TURNS), None, N).opening is None
