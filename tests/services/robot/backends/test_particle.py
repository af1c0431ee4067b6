"""The particle in an arm's place: three slides, and what they touch."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from services.robot.backends.backend import CONTROL_PERIOD
from services.robot.backends.particle import ParticleBackend, ParticleKinematics
from sim.tasks import PARTICLE

FREE, OBSTACLE = PARTICLE.variants
IDENTITY = np.array([1.0, 0.0, 0.0, 0.0])
POINTS = st.tuples(*[st.floats(-0.4, 0.4)] * 3).map(np.array)


def started(variant):
    """A particle that was told to be where it is: what comes next may be anywhere."""
    backend = ParticleBackend(PARTICLE, variant)
    backend.connect()
    backend.command(backend.observe().q, np.zeros(3), 0.0)
    return backend


@given(POINTS, POINTS)
def test_steps_go_straight_to_the_position_and_no_faster_than_they_may(here, there):
    kinematics = ParticleKinematics(PARTICLE.freedom.axes)
    q, qd = kinematics.solve_step(here, there, IDENTITY, 0.01)
    assert np.all(np.abs(qd) <= kinematics.velocity_limit * (1.0 + 1e-12))
    np.testing.assert_allclose(q, here + 0.01 * qd, atol=1e-12)
    for _ in range(100):
        q, _ = kinematics.solve_step(q, there, IDENTITY, 0.01)
    np.testing.assert_allclose(kinematics.forward(q).position, there, atol=1e-12)
    np.testing.assert_array_equal(kinematics.forward(q).orientation, IDENTITY)


def test_the_backend_is_where_it_was_told_to_be_one_period_later():
    backend = started(FREE)
    backend.command(np.array([0.1, 0.05, 0.0]), np.array([0.04, 0.02, 0.0]), 0.0)
    backend.elapse()
    seen = backend.observe()
    assert seen.time == pytest.approx(CONTROL_PERIOD)
    np.testing.assert_array_equal(seen.q, [0.1, 0.05, 0.0])
    np.testing.assert_array_equal(seen.qd, [0.04, 0.02, 0.0])
    np.testing.assert_array_equal(seen.world, [0.1, 0.05, 0.0, 0.0, 0.0])


def test_a_reset_puts_particle_and_via_points_in_place():
    backend = started(FREE)
    backend.command(np.array([0.1, 0.05, 0.0]), np.zeros(3), 0.0)
    backend.elapse()
    backend.reset(np.array([0.1, -0.07]), OBSTACLE, np.zeros(3))
    seen = backend.observe()
    assert (seen.time, backend.variant) == (0.0, OBSTACLE)
    np.testing.assert_array_equal(seen.q, 0.0)
    np.testing.assert_array_equal(seen.condition, [0.1, -0.07])
    np.testing.assert_allclose(seen.object_pose.position, [PARTICLE.via_x[1], -0.07, 0.0])


@pytest.mark.parametrize(
    ("variant", "position", "touching"),
    [
        (OBSTACLE, (0.07, 0.0, 0.0), True),
        (OBSTACLE, (0.0441, 0.0, 0.0), True),
        (OBSTACLE, (0.0439, 0.0, 0.0), False),
        (OBSTACLE, (0.07, 0.0309, 0.0), True),
        (OBSTACLE, (0.07, 0.0311, 0.0), False),
        (FREE, (0.07, 0.0, 0.0), False),
    ],
)
def test_the_particle_touches_the_obstacle_with_its_surface(variant, position, touching):
    backend = started(variant)
    for way in ((0.0, 0.1, 0.0), (position[0] - 0.001, 0.1, 0.0), position):  # around the obstacle, onto its surface
        backend.command(np.array(way), np.zeros(3), 0.0)
        backend.elapse()
    touch = backend.observe().touch
    assert (touch is not None) == touching
    if touch is not None:
        assert touch.between == ("particle", "block")


def test_what_the_particle_passes_through_within_a_period_is_touched():
    backend = started(OBSTACLE)
    backend.command(np.array([0.12, 0.0, 0.0]), np.zeros(3), 0.0)
    backend.elapse()
    touch = backend.observe().touch
    assert touch is not None
    assert touch.between == ("particle", "block")
    backend.command(np.array([0.13, 0.0, 0.0]), np.zeros(3), 0.0)
    backend.elapse()
    assert backend.observe().touch is None
