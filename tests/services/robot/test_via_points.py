"""The verdict on a motion through via-points."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from services.robot.backends.backend import Touch
from services.robot.backends.particle import ParticleBackend
from services.robot.via_points import ViaPointCriteria, ViaPointJudge
from sim.pose import Pose
from sim.tasks import PARTICLE

IDENTITY = np.array([1.0, 0.0, 0.0, 0.0])
NOWHERE = Pose(np.zeros(3), IDENTITY)
CRITERIA = ViaPointCriteria(PARTICLE.via_x, PARTICLE.tolerance)


def passed(y_first, y_second, condition=(0.1, -0.05), touch=None):
    """The verdict after a straight motion at one height, and one at another."""
    judge = CRITERIA.begin(seen(condition))
    for x in np.arange(0.0, 0.4001, 0.0004):
        y = y_first if x < 0.3 else y_second
        verdict = judge.judge(Pose(np.array([x, y, 0.0]), IDENTITY), NOWHERE, touch if x > 0.2 else None)
    return verdict


def seen(condition):
    backend = ParticleBackend(PARTICLE, "free")
    backend.reset(np.array(condition), "free", np.zeros(3))
    return backend.observe()


def test_reached_is_both_via_points_within_the_tolerance():
    assert passed(0.1, -0.05).success
    assert passed(0.1099, -0.0599).reached
    assert not passed(0.1101, -0.05).reached
    assert not passed(0.1, -0.0601).reached
    assert passed(0.105, -0.05).ellipsoid_value == pytest.approx(0.25)
    assert passed(0.105, -0.05).missed == pytest.approx(0.005)


def test_nothing_is_reached_before_the_last_via_point_lies_behind():
    judge = CRITERIA.begin(seen((0.0, 0.0)))
    for x in np.arange(0.0, 0.3599, 0.001):
        assert not judge.judge(Pose(np.array([x, 0.0, 0.0]), IDENTITY), NOWHERE, None).reached
    assert judge.judge(Pose(np.array([0.3601, 0.0, 0.0]), IDENTITY), NOWHERE, None).reached


@given(st.floats(-0.2, 0.2), st.floats(-3.0, 3.0), st.floats(0.0005, 0.02))
def test_the_y_at_a_via_point_is_that_of_the_line_between_two_periods(y, slope, step):
    judge = ViaPointJudge(ViaPointCriteria((0.2,), 0.01), np.array([y]))
    for x in np.arange(0.0, 0.25, step):
        verdict = judge.judge(Pose(np.array([x, y + slope * (x - 0.2), 0.0]), IDENTITY), NOWHERE, None)
    assert verdict.ellipsoid_value == pytest.approx(0.0, abs=1e-9)
    assert verdict.reached


def test_a_collision_stays_and_nothing_is_ever_kicked_over():
    touch = Touch(np.zeros(3), 0.0, ("particle", "block"))
    verdict = passed(0.1, -0.05, touch=touch)
    assert verdict.collision is touch
    assert not verdict.success
    assert not verdict.kicked_over
