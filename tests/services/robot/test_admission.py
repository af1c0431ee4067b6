import re

import numpy as np
import pytest

from lfd.motion.rotations import exp_map
from protocol.queries import Reset
from services.robot.admission import admit_prediction, admit_reset, admit_target
from services.robot.refusal import Refusal
from sim.pose import Pose
from sim.tasks import scene

IDENTITY = np.array([1.0, 0.0, 0.0, 0.0])
MEASURED = Pose(np.array([0.5, 0.0, 0.8]), IDENTITY)


def line(n=75, length=0.3, start=0.5):
    positions = np.column_stack([np.linspace(start, start + length, n), np.zeros(n), np.full(n, 0.8)])
    return positions, np.tile(IDENTITY, (n, 1))


def test_a_sound_prediction_passes_unchanged():
    positions, orientations = line()
    prediction = admit_prediction(positions, orientations, 10.0, MEASURED)
    np.testing.assert_array_equal(prediction.positions, positions)


@pytest.mark.parametrize(
    ("motion", "duration", "reason"),
    [
        (line(), 0.1, "takes 0.1 s"),
        (line(), 1e4, "takes"),
        (line(length=2.0), 1.0, "moves at 2.00 m/s after way-point"),
        (line(n=1001), 10.0, "1001 way-points"),
        (line(start=1.2), 10.0, "starts 0.70 m away"),
        ((line()[0] * np.nan, line()[1]), 10.0, "not a finite number"),
        ((line()[0], line()[1] * 2.0), 10.0, "unit quaternion"),
        ((line()[0], line(n=74)[1]), 10.0, "shape"),
    ],
)
def test_an_unsound_prediction_is_refused_with_one_clear_line(motion, duration, reason):
    with pytest.raises(Refusal, match=reason) as refused:
        admit_prediction(*motion, duration, MEASURED)
    assert "\n" not in str(refused.value)


def turning(speed, n=75, duration=10.0):
    """A motion that stands and turns [rad/s]."""
    turns = np.outer(np.linspace(0.0, speed * duration, n), [0.0, 0.0, 1.0])
    return np.tile(MEASURED.position, (n, 1)), exp_map(turns)


@pytest.mark.parametrize(
    ("motion", "duration"),
    [
        (line(n=1000), 10.0),
        (line(n=2), 10.0),
        (line(), 0.5),
        (line(length=0.05), 120.0),
        (line(length=1.0 - 1e-9), 1.0),
        (line(n=2, length=0.5), 0.5),
        (turning(3.0 - 1e-9), 10.0),
        (line(start=1.0), 10.0),
        (line(start=0.0), 10.0),
    ],
)
def test_a_prediction_at_the_limits_passes(motion, duration):
    assert admit_prediction(*motion, duration, MEASURED).duration == duration


@pytest.mark.parametrize(
    ("motion", "duration", "reason"),
    [
        (line(n=1001), 10.0, "has 1001 way-points, at most 1000 are allowed"),
        (line(), 0.499, "takes 0.499 s: give 0.5 to 120 s"),
        (line(length=0.05), 120.1, "takes 120 s: give 0.5 to 120 s"),
        (line(length=1.01), 1.0, "moves at 1.01 m/s after way-point"),
        (turning(3.01), 10.0, "turns at 3.01 rad/s after way-point"),
        (line(start=1.01), 10.0, "starts 0.51 m away from the gripper, at most 0.5 m is allowed"),
        (line(start=-0.01), 10.0, "starts 0.51 m away"),
    ],
)
def test_a_prediction_just_beyond_them_is_refused(motion, duration, reason):
    with pytest.raises(Refusal, match=reason):
        admit_prediction(*motion, duration, MEASURED)


def test_the_way_point_that_is_too_fast_is_named():
    positions, orientations = line(n=11, length=0.1)
    positions[7:] += 0.5
    with pytest.raises(Refusal, match="after way-point 6"):
        admit_prediction(positions, orientations, 1.0, MEASURED)


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_motion_starts_within_reach_of_the_scenes_own_start(axis, side):
    table = scene("dishwasher")
    place, offset = table.training_positions[0], np.zeros(3)
    offset[axis] = side
    for far, refused in ((0.2999, False), (0.3001, True)):
        start = Pose(table.start.position + far * offset, IDENTITY)
        if refused:
            with pytest.raises(Refusal, match="no motion can start at"):
                admit_reset(table, "b1", place, start)
        else:
            admit_reset(table, "b1", place, start)


def test_the_region_that_is_named_is_the_one_that_is_allowed():
    table = scene("dishwasher")
    with pytest.raises(Refusal) as refused:
        admit_reset(table, "b1", np.full(3, 9.0))
    numbers = [float(number) for number in re.findall(r"-?\d+\.\d{3}", str(refused.value))]
    lower, upper = np.array(numbers[3:6]), np.array(numbers[6:9])
    assert numbers[:3] == [9.0] * 3
    for corner in (lower + 0.001, upper - 0.001):
        admit_reset(table, "b1", corner)
    for corner in (lower - 0.001, upper + 0.001):
        with pytest.raises(Refusal):
            admit_reset(table, "b1", corner)


def test_a_prediction_that_spins_is_refused():
    positions, orientations = line()
    orientations[40] = [0.0, 1.0, 0.0, 0.0]
    with pytest.raises(Refusal, match="turns at"):
        admit_prediction(positions, orientations, 10.0, MEASURED)


def test_a_reset_names_the_variants_and_the_region():
    dishwasher = scene("dishwasher")
    place = dishwasher.training_positions[0]
    admit_reset(dishwasher, "b2", place)
    with pytest.raises(Refusal, match="b1, b2"):
        admit_reset(dishwasher, "b3", place)
    with pytest.raises(Refusal, match="cannot stand at"):
        admit_reset(dishwasher, "b1", place + np.array([0.3, 0.0, 0.0]))
    with pytest.raises(Refusal, match="cannot stand at"):
        admit_reset(dishwasher, "b1", place * np.nan)


def test_a_reset_is_asked_for_what_the_scene_has():
    dishwasher, particle = scene("dishwasher"), scene("particle")
    np.testing.assert_array_equal(admit_target(dishwasher, Reset(1, object_position=(0.8, 0.0, 0.5))), [0.8, 0.0, 0.5])
    np.testing.assert_array_equal(admit_target(particle, Reset(1, condition=(0.1, -0.1))), [0.1, -0.1])
    assert admit_target(dishwasher, Reset(1)) is None
    assert admit_target(particle, Reset(1)) is None
    with pytest.raises(Refusal, match="no condition of its own"):
        admit_target(dishwasher, Reset(1, condition=(0.1, -0.1)))
    with pytest.raises(Refusal, match="has no object"):
        admit_target(particle, Reset(1, object_position=(0.8, 0.0, 0.5)))


def test_a_start_lies_near_the_scenes_own():
    dishwasher = scene("dishwasher")
    place, home = dishwasher.training_positions[0], dishwasher.start
    admit_reset(dishwasher, "b1", place, Pose(home.position + np.array([0.1, -0.1, 0.1]), home.orientation))
    for far in (home.position + np.array([0.0, 0.0, 0.31]), home.position * np.nan):
        with pytest.raises(Refusal, match=r"give a place within 0\.3 m of \(0\.537, 0\.083, 0\.444\) m"):
            admit_reset(dishwasher, "b1", place, Pose(far, home.orientation))


@pytest.mark.parametrize(
    ("waypoints", "place"),
    [
        ((), "after way-point 37"),
        ((0.0, 0.4, 1.0), "after waypoint 2"),
        ((0.6, 0.8, 1.0), "before waypoint 1"),
    ],
)
def test_a_place_on_a_motion_is_named_by_the_waypoints_of_whoever_showed_it(waypoints, place):
    positions, orientations = line()
    positions[38:, 1] = 0.2
    with pytest.raises(Refusal, match=place):
        admit_prediction(positions, orientations, 10.0, MEASURED, waypoints)
