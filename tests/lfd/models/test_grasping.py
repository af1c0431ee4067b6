"""Models of motions in which the gripper takes part."""

from dataclasses import replace

import numpy as np
import pytest

from lfd.exceptions import OpeningMismatch
from lfd.models.adaptive.adaptation import AdaptiveOptions, AdaptiveProMP
from lfd.models.distribution import blend
from lfd.models.dmp import DMP
from lfd.models.promp import ConditionedProMP, PrompOptions
from lfd.models.via_point import ViaPoint
from lfd.motion.trajectory import PREDICTION_POINTS, equal_phases
from tests.lfd.conftest import _reaching

OPEN = 0.08
PLACES = [(0.8, -0.2, 0.4), (0.8, 0.2, 0.4), (0.9, 0.0, 0.5), (0.75, 0.1, 0.45)]
MODELS = [AdaptiveProMP, ConditionedProMP]
SAMPLE = 1.0 / (PREDICTION_POINTS - 1)


def grasping(place, at=0.8, before=OPEN, after=0.0):
    """A reach that closes the gripper at a phase."""
    shown = _reaching(place)
    opening = np.where(shown.trajectory.phases < at, before, after)
    return replace(shown, trajectory=replace(shown.trajectory, opening=opening))


def plain(place):
    return _reaching(place)


def opening(model, place):
    return model.predict(plain(place).situation).trajectory.opening


def closes(predicted):
    return equal_phases(len(predicted))[np.argmax(predicted < OPEN / 2)]


def between(predicted):
    """How many points are neither open nor closed, to within a millimetre."""
    return np.count_nonzero((predicted > 0.001) & (predicted < OPEN - 0.001))


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("place", [*PLACES, (0.82, 0.05, 0.42), (1.1, -0.6, 0.3)])
def test_a_step_that_was_shown_is_predicted_as_a_step_at_its_moment(model, place):
    predicted = opening(model.fit([grasping(p) for p in PLACES]), place)
    assert between(predicted) <= 2
    assert closes(predicted) == pytest.approx(0.8, abs=2 * SAMPLE)
    assert predicted.min() >= 0.0
    assert predicted.max() <= OPEN
    np.testing.assert_allclose(predicted[equal_phases(len(predicted)) < 0.77], OPEN, atol=0.001)


@pytest.mark.parametrize("model", MODELS)
def test_a_moment_that_goes_with_the_condition_is_predicted_between(model):
    shown = [grasping((0.8, y, 0.4), 0.7 + 0.5 * y) for y in (-0.2, -0.1, 0.1, 0.2)]
    predicted = opening(model.fit(shown), (0.8, 0.0, 0.4))
    assert closes(predicted) == pytest.approx(0.7, abs=2 * SAMPLE)
    assert between(predicted) <= 2


@pytest.mark.parametrize("model", MODELS)
def test_an_opening_that_is_steady_is_predicted_steady(model):
    model = model.fit([grasping(p, before=0.05, after=0.05) for p in PLACES])
    np.testing.assert_allclose(opening(model, (0.82, 0.05, 0.42)), 0.05, atol=1e-9)


def test_one_correction_moves_the_moment_of_closing_there_and_not_far_away():
    place = PLACES[1]
    before = AdaptiveProMP.fit([grasping(p) for p in PLACES])
    after = before.updated(grasping(place, 0.65))
    assert closes(opening(after, place)) == pytest.approx(0.65, abs=2 * SAMPLE)
    assert between(opening(after, place)) <= 2
    far = (0.8, 9.0, 0.4)
    np.testing.assert_allclose(opening(after, far), opening(before, far), atol=0.001)
    np.testing.assert_array_equal(opening(after.undone(), place), opening(before, place))


def test_a_correction_that_closes_at_last_is_followed_at_once():
    model = AdaptiveProMP.fit([grasping(p, at=2.0) for p in PLACES])
    assert opening(model, PLACES[0]).min() == OPEN
    predicted = opening(model.updated(grasping(PLACES[0], 0.9)), PLACES[0])
    assert predicted[-1] < 0.001
    assert closes(predicted) == pytest.approx(0.9, abs=2 * SAMPLE)


def test_a_correction_may_open_wider_than_any_demonstration_and_undone_it_is_forgotten():
    model = AdaptiveProMP.fit([grasping(p, before=0.05) for p in PLACES])
    wider = model.updated(grasping(PLACES[0]))
    assert opening(wider, PLACES[0]).max() == pytest.approx(OPEN, abs=0.001)
    assert opening(wider.undone(), PLACES[0]).max() <= 0.05


def test_a_correction_believed_by_half_moves_the_moment_by_half():
    newer = grasping(PLACES[1], 0.6)
    halfway = replace(newer, provenance=replace(newer.provenance, confidence=0.5))
    model = AdaptiveProMP.fit([grasping(p) for p in PLACES]).updated(halfway)
    assert 0.6 + SAMPLE < closes(opening(model, PLACES[1])) < 0.8 - SAMPLE


def test_a_correction_of_a_part_moves_the_moment_within_it():
    newer = replace(grasping(PLACES[1], 0.7), part=(0.5, 0.75))
    model = AdaptiveProMP.fit([grasping(p) for p in PLACES]).updated(newer)
    assert closes(opening(model, PLACES[1])) == pytest.approx(0.7, abs=2 * SAMPLE)


@pytest.mark.parametrize("model", MODELS)
def test_the_poses_are_the_same_with_the_gripper_and_without(model):
    with_it, without = model.fit([grasping(p) for p in PLACES]), model.fit([plain(p) for p in PLACES])
    situation = plain((0.82, 0.05, 0.42)).situation
    one, other = with_it.predict(situation), without.predict(situation)
    np.testing.assert_allclose(one.trajectory.positions, other.trajectory.positions, atol=1e-9)
    np.testing.assert_allclose(one.position_covariances, other.position_covariances, atol=1e-9)
    assert other.trajectory.opening is None


@pytest.mark.parametrize("model", MODELS)
def test_motions_with_and_without_the_gripper_make_no_model(model):
    with pytest.raises(OpeningMismatch):
        model.fit([grasping(PLACES[0]), plain(PLACES[1])])
    with pytest.raises(OpeningMismatch):
        model.fit([grasping(p) for p in PLACES]).updated(plain(PLACES[0]))
    with pytest.raises(OpeningMismatch):
        model.fit([plain(p) for p in PLACES]).updated(grasping(PLACES[0]))


def test_welfords_update_moves_the_moment_by_its_share():
    model = ConditionedProMP.fit([grasping(PLACES[0])], PrompOptions(anchored=True))
    assert closes(opening(model.updated(grasping(PLACES[0], 0.6)), PLACES[0])) == pytest.approx(0.7, abs=2 * SAMPLE)


def test_a_primitive_closes_at_the_phase_that_it_was_shown():
    shown = grasping(PLACES[0]).trajectory
    start = (shown.positions[0], shown.orientations[0])
    goal = (shown.positions[-1] + 0.1, shown.orientations[-1])
    predicted = DMP.fit(shown).reproduce(start, goal, 9.0).opening
    assert closes(predicted) == pytest.approx(0.8, abs=2 * SAMPLE)
    assert DMP.fit(plain(PLACES[0]).trajectory).reproduce(start, goal, 9.0).opening is None


def test_a_motion_led_through_a_point_or_drawn_by_chance_closes_whole(rng):
    motion = AdaptiveProMP.fit([grasping(p) for p in PLACES]).distribution(plain(PLACES[0]).situation)
    led = motion.through(ViaPoint(0.5, motion.trajectory(75).positions[37] + 0.03, 1e-6 * np.eye(3)))
    assert between(led.trajectory(75).opening) <= 3
    for drawn in motion.sample(rng, 5, 75):
        assert drawn.opening[0] == pytest.approx(OPEN, abs=0.002)
        assert drawn.opening[-1] == pytest.approx(0.0, abs=0.002)


def test_two_motions_blended_close_as_the_one_that_is_under_way():
    early, late = (
        AdaptiveProMP.fit([grasping(p, at) for p in PLACES]).distribution(plain(PLACES[0]).situation)
        for at in (0.3, 0.9)
    )
    motion, _ = blend(early, late, np.linspace(0.0, 1.0, 101))
    assert between(motion.opening) <= 4
    assert motion.opening[40] == pytest.approx(0.0, abs=1e-3)
    assert motion.opening[60] == pytest.approx(OPEN, abs=1e-3)


def test_many_demonstrations_are_averaged_with_their_moments():
    model = AdaptiveProMP.fit([grasping(PLACES[0], at) for at in (0.7, 0.8, 0.9)], AdaptiveOptions(most=1))
    assert closes(opening(model, PLACES[0])) == pytest.approx(0.8, abs=2 * SAMPLE)
