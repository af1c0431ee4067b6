"""The thesis' 2D example: what it promises of via-points, obstacle and ways, and how it is drawn."""

import itertools
from contextlib import closing

import numpy as np
import pytest

from sim.interpolation import through
from sim.person.intention import plan_at_equal_progress
from sim.person.steering import steer
from sim.robots.description import RobotDescription
from sim.tasks import PARTICLE
from sim.tasks.particle import OBSTACLE_TRAINING, X_UNIT, Y_UNIT
from sim.tasks.scene import NO_ROTATION, Box, Group
from sim.world.cameras import Cameras

FREE, OBSTACLE = PARTICLE.variants
NINE = [Y_UNIT * np.array(s) for s in itertools.product((-10.0, 0.0, 10.0), repeat=2)]
GRID = [Y_UNIT * np.array(s) for s in itertools.product(np.linspace(-20.0, 20.0, 9), repeat=2)]
MARGIN = 0.01  # [m] between the particle's surface and the obstacle


def block() -> Box:
    (box,) = (box for box in PARTICLE.boxes(OBSTACLE) if box.group is Group.SOLID)
    return box


def line(variant: str, condition: np.ndarray) -> np.ndarray:
    way = PARTICLE.corridor(variant, condition).positions
    return through(way, np.linspace(0.0, len(way) - 1.0, 4001))


def clearance(positions: np.ndarray) -> float:
    """Between the particle's surface and the obstacle [m]."""
    box = block()
    beyond = np.maximum(np.abs(positions - box.centre) - box.half_sizes, 0.0)
    return np.linalg.norm(beyond, axis=1).min() - PARTICLE.radius


def test_the_nine_conditions_are_drawn_and_twice_as_far_is_allowed() -> None:
    assert all(PARTICLE.region.contains(s) for s in NINE)
    assert all(PARTICLE.region.contains(s, PARTICLE.margin) for s in GRID)
    assert not PARTICLE.region.contains(np.array([0.21, 0.0]), PARTICLE.margin)
    assert not PARTICLE.region.contains(np.zeros(3), PARTICLE.margin)


@pytest.mark.parametrize("variant", PARTICLE.variants)
def test_every_way_moves_along_x_at_a_constant_speed_and_passes_through_both_via_points(variant: str) -> None:
    for condition in GRID:
        way = PARTICLE.corridor(variant, condition).positions
        np.testing.assert_allclose(way[:, 0], np.linspace(0.0, 4.0 * X_UNIT, len(way)), atol=1e-12)
        np.testing.assert_array_equal(way[0], PARTICLE.start.position)
        np.testing.assert_array_equal(way[:, 2], 0.0)
        fine = line(variant, condition)
        np.testing.assert_allclose(np.interp([2.0 * X_UNIT, 3.6 * X_UNIT], *fine.T[:2]), condition, atol=1e-6)
        slopes = np.diff(way[:, 1]) / np.diff(way[:, 0])
        assert np.abs(np.diff(slopes)).max() <= 0.5 * np.abs(slopes).max(), "no kink"


def test_the_lower_left_corner_of_the_obstacle_is_at_half_a_unit() -> None:
    assert block().centre[0] - block().half_sizes[0] == pytest.approx(0.5 * X_UNIT)
    assert [box for box in PARTICLE.boxes(FREE) if box.group is Group.SOLID] == []


def test_without_the_obstacle_every_way_was_taught_into_it() -> None:
    for condition in [*OBSTACLE_TRAINING, *GRID]:
        assert clearance(line(FREE, condition)) < 0.0


def test_with_the_obstacle_every_way_keeps_clear_of_it() -> None:
    for condition in GRID:
        assert clearance(line(OBSTACLE, condition)) > MARGIN


def test_a_way_is_linear_in_the_condition() -> None:
    """So that a linear trend can generalise from a few conditions to all."""
    for variant in PARTICLE.variants:
        nothing, first, second, both = (
            PARTICLE.corridor(variant, np.array(s)).positions for s in ((0, 0), (0.1, 0), (0, 0.1), (0.1, 0.1))
        )
        np.testing.assert_allclose(both - nothing, first - nothing + second - nothing, atol=1e-12)


def test_a_person_steers_it_in_y_only_and_not_its_tempo() -> None:
    corridor = PARTICLE.corridor(OBSTACLE, NINE[0])
    steered = steer(corridor, np.random.default_rng(0), n=81, freedom=PARTICLE.freedom).positions
    np.testing.assert_allclose(steered[:, [0, 2]], corridor.positions[:, [0, 2]], atol=1e-9)
    deviation = np.abs(steered[:, 1] - corridor.positions[:, 1]).max()
    assert 1e-4 < deviation < 0.01


@pytest.mark.parametrize("variant", PARTICLE.variants)
def test_the_correction_is_the_safe_y_less_the_predicted_y_at_equal_progress(variant: str) -> None:
    condition = np.array([0.08, -0.05])
    predicted = np.column_stack([np.linspace(0.0, 4.0 * X_UNIT, 75), np.full(75, 0.013), np.zeros(75)])
    correction = plan_at_equal_progress(predicted, np.tile(NO_ROTATION, (75, 1)), PARTICLE.corridor(variant, condition))
    np.testing.assert_allclose(correction.displacements[:, [0, 2]], 0.0, atol=1e-9)
    np.testing.assert_array_equal(correction.rotations, 0.0)
    for share in (2.0 / 4.0, 3.6 / 4.0):
        y = condition[0] if share == 0.5 else condition[1]
        assert correction.displacement(share)[1] == pytest.approx(y - 0.013, abs=2e-3)
        assert correction.pose(share).position[1] == pytest.approx(y, abs=2e-3)


def test_the_rings_are_as_wide_as_the_tolerance_and_stand_where_the_condition_says() -> None:
    for ring, x, y in zip(PARTICLE.rings(np.array([0.1, -0.2])), (2.0, 3.6), (0.1, -0.2), strict=True):
        centres = np.array([box.centre for box in ring])
        np.testing.assert_allclose(centres.mean(axis=0), [x * X_UNIT, y, 0.0], atol=1e-12)
        distances = np.linalg.norm(centres - centres.mean(axis=0), axis=1)
        np.testing.assert_allclose(distances, PARTICLE.tolerance)


@pytest.mark.sim
def test_the_head_camera_draws_the_plane_with_x_to_the_right_and_y_up(description: RobotDescription) -> None:
    """The particle is the only thing that is red, and is where the pinhole says."""
    with closing(Cameras(PARTICLE, description)) as cameras:
        for x, y in ((0.0, 0.0), (0.4, 0.2), (0.1, -0.2)):
            state = np.array([x, y, 0.0, 0.1, -0.1])
            picture = cameras.render("head", state).astype(int)
            red = (picture[:, :, 0] > 100) & (picture[:, :, 1:].max(axis=2) < 70)
            rows, columns = np.nonzero(red)
            camera = cameras.pose("head", state)
            depth = camera.position[2]
            matrix = cameras.intrinsics("head")
            u = matrix[0, 2] + matrix[0, 0] * (x - camera.position[0]) / depth
            v = matrix[1, 2] - matrix[1, 1] * (y - camera.position[1]) / depth
            assert (columns.mean(), rows.mean()) == pytest.approx((u, v), abs=1.0)


@pytest.mark.sim
def test_via_points_and_obstacle_are_drawn_where_the_state_says(description: RobotDescription) -> None:
    with closing(Cameras(PARTICLE, description)) as cameras:
        before = cameras.render("head", np.zeros(5))
        moved = cameras.render("head", np.array([0.0, 0.0, 0.0, 0.1, -0.1]))
        assert np.any(before != moved)
        cameras.show(OBSTACLE)
        blocked = cameras.render("head", np.zeros(5))
        assert np.mean(np.any(blocked != before, axis=2)) > 0.005
        assert cameras.render("wrist", np.zeros(5)).std() > 5.0
