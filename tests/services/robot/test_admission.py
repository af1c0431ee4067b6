import numpy as np
import pytest

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
