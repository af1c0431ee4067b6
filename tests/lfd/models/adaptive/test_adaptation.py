"""One correction is enough, and acts where it should."""

import numpy as np
import pytest

from lfd.exceptions import NothingToTakeBack, TooFewDemonstrations, WrongShape
from lfd.models.adaptive.adaptation import AdaptiveOptions, AdaptiveProMP
from lfd.models.adaptive.correction import CorrectionOptions
from tests.lfd.models.adaptive.motions import LEFT, MIDDLE, RIGHT, gap, path, predict, standard_deviation, straight


@pytest.fixture
def model(reach):
    return AdaptiveProMP.fit([reach(LEFT), reach(RIGHT)])


@pytest.mark.parametrize("target", [LEFT, MIDDLE, RIGHT, [0.7, 0.1, 0.9]])
def test_one_correction_is_enough(model, reach, target):
    correction = reach(target, bend=0.25, duration=9.0)
    corrected = model.updated(correction)
    assert gap(corrected, correction) < 0.05 * gap(model, correction)
    assert predict(corrected, correction).trajectory.duration == pytest.approx(9.0, rel=0.05)


def test_the_newest_of_contradicting_corrections_wins(model, reach):
    bends = [0.25, -0.25, 0.1, -0.2]
    for bend in bends:
        model = model.updated(reach(MIDDLE, bend=bend))
    assert gap(model, reach(MIDDLE, bend=bends[-1])) < 0.02


@pytest.mark.parametrize(("apart", "most"), [(0.005, 1.05), (0.02, 1.05), (0.05, 1.05), (0.1, 1.5), (0.2, 2.0)])
def test_contradicting_corrections_side_by_side_do_not_run_away(model, reach, apart, most):
    """Beyond two opposite corrections the prediction departs little further than they did."""
    model = model.updated(reach(MIDDLE, bend=0.2)).updated(reach(np.add(MIDDLE, [0.0, apart, 0.0]), bend=-0.2))
    for y in np.linspace(-0.15, 0.25, 11):
        straight = reach([0.9, y, 0.6])
        difference = predict(model, straight).trajectory.positions - straight.trajectory.positions
        assert np.abs(difference[:, 1]).max() < most * 0.2


def sideways(model, corrected, reach, offset):
    """By how much a correction moves the prediction for an object further to the right by `offset` [m]."""
    elsewhere = reach(np.add(LEFT, [0.0, -offset, 0.0]))
    change = predict(corrected, elsewhere).trajectory.positions - predict(model, elsewhere).trajectory.positions
    return np.abs(change).max()


def test_a_correction_fades_with_distance_and_leaves_far_places_alone(model, reach):
    corrected = model.updated(reach(LEFT, bend=0.25))
    moved = [sideways(model, corrected, reach, offset) for offset in (0.0, 0.03, 0.06, 0.1, 0.2, 0.4, 0.8, 2.0, 4.0)]
    assert (np.diff(moved) < 0.0).all()
    assert moved[-1] < 0.1 * moved[0]


def test_a_correction_acts_wider_the_more_it_surprises(model, reach):
    """A small one is a detail of its place; a large one says that the world has changed."""
    shares = []
    for bend in (0.01, 0.05, 0.25):
        corrected = model.updated(reach(LEFT, bend=bend))
        shares.append(sideways(model, corrected, reach, 0.2) / sideways(model, corrected, reach, 0.0))
    assert (np.diff(shares) > 0.0).all()
    assert shares[-1] > 0.75


def test_where_the_demonstrations_left_a_trend_open_a_correction_teaches_it_and_keeps_what_was_taught(reach):
    """One demonstration says nothing about other conditions: correcting one of them is no reason to forget it."""
    taught = straight([0.0, 0.0])
    corrected = AdaptiveProMP.fit([taught]).updated(straight([0.1, -0.1]))
    np.testing.assert_allclose(path(corrected, taught), taught.trajectory.positions, atol=0.004)
    half = straight([0.05, -0.05])
    np.testing.assert_allclose(path(corrected, half), half.trajectory.positions, atol=0.006)


def test_taking_back_a_correction_gives_the_model_before_it(model, reach):
    corrected = model.updated(reach(MIDDLE, bend=0.2))
    again = corrected.updated(reach(LEFT, bend=-0.1)).undone()
    for wanted in (reach(MIDDLE), reach(LEFT)):
        np.testing.assert_allclose(path(again, wanted), path(corrected, wanted), atol=1e-12)
    with pytest.raises(NothingToTakeBack):
        model.undone()


def test_memory_is_bounded_and_the_newest_corrections_are_kept(reach):
    options = AdaptiveOptions(correction=CorrectionOptions(most=3))
    model = AdaptiveProMP.fit([reach(LEFT), reach(RIGHT)], options)
    for bend in (0.1, 0.2, -0.1, 0.05, 0.15):
        model = model.updated(reach(MIDDLE, bend=bend))
    assert len(model.corrections) == 3
    assert gap(model, reach(MIDDLE, bend=0.15)) < 0.01


def test_a_condition_of_another_dimension_is_refused(model):
    with pytest.raises(WrongShape):
        model.updated(straight([0.1, 0.2]))
    with pytest.raises(WrongShape):
        model.predict(straight([0.1, 0.2]).situation)
    with pytest.raises(WrongShape):
        AdaptiveProMP.fit([straight([0.1, 0.2]), straight([0.1])])


def test_a_motion_seen_twice_changes_nothing(model, reach):
    again = predict(model.updated(reach(LEFT)), reach(MIDDLE)).trajectory.positions
    np.testing.assert_allclose(again, predict(model, reach(MIDDLE)).trajectory.positions, atol=2e-3)


def test_uncertainty_grows_away_from_what_was_taught_and_is_none_at_the_start(model, reach):
    away = [reach(np.add(LEFT, [0.0, offset, 0.0])) for offset in (0.0, 0.05, 0.1, 0.3, 0.6)]
    deviations = [standard_deviation(model, d) for d in away]
    assert (np.diff(deviations) > 0.0).all()
    covariances = predict(model, away[-1]).position_covariances
    np.testing.assert_allclose(covariances[0], 0.0, atol=1e-12)
    assert np.linalg.eigvalsh(covariances).min() > -1e-12


def test_a_correction_makes_the_model_sure_of_its_condition(model, reach):
    correction = reach(MIDDLE, bend=0.25)
    assert standard_deviation(model.updated(correction), correction) < 0.5 * standard_deviation(model, correction)


def test_an_update_leaves_the_old_model_as_it_was(model, reach):
    before = predict(model, reach(MIDDLE)).trajectory.positions
    model.updated(reach(MIDDLE, bend=0.25))
    np.testing.assert_array_equal(predict(model, reach(MIDDLE)).trajectory.positions, before)


def test_nothing_to_learn_from_is_refused():
    with pytest.raises(TooFewDemonstrations):
        AdaptiveProMP.fit([])
