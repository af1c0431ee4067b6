"""One correction is enough, and acts where it should."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from lfd.exceptions import NothingToTakeBack, TooFewDemonstrations, WrongShape
from lfd.models.adaptive.adaptation import AdaptiveOptions, AdaptiveProMP
from lfd.models.adaptive.correction import CorrectionOptions
from lfd.motion.demonstration import Provenance
from tests.lfd.models.adaptive.motions import (
    LEFT,
    MIDDLE,
    RIGHT,
    decoded,
    gap,
    path,
    placed,
    predict,
    standard_deviation,
    straight,
)


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


def moved(model, corrected, elsewhere):
    """By how much a correction moves the prediction of another motion at most, on any axis [m]."""
    return np.abs(path(corrected, elsewhere) - path(model, elsewhere)).max()


def test_a_correction_fades_with_distance_and_leaves_far_places_alone(model, reach):
    corrected = model.updated(reach(LEFT, bend=0.25))
    offsets = (0.0, 0.03, 0.06, 0.1, 0.2, 0.4, 0.8, 2.0, 4.0)
    changes = [moved(model, corrected, reach(np.add(LEFT, [offset, 0.0, 0.0]))) for offset in offsets]
    assert (np.diff(changes) < 0.0).all()
    assert changes[-1] < 0.1 * changes[0]


def test_a_correction_acts_wider_the_more_it_surprises(model, reach):
    """A small one is a detail of its place; a large one says that the world has changed."""
    shares = []
    here, nearer = reach(LEFT), reach(np.add(LEFT, [-0.2, 0.0, 0.0]))
    for bend in (0.01, 0.05, 0.25):
        corrected = model.updated(reach(LEFT, bend=bend))
        shares.append(moved(model, corrected, nearer) / moved(model, corrected, here))
    assert (np.diff(shares) > 0.0).all()
    assert shares[-1] > 0.75


@pytest.mark.parametrize("bend", [0.25, -0.25])
def test_what_a_correction_led_round_is_passed_with_room_from_every_start_to_every_object(model, reach, bend):
    corrected = model.updated(reach(MIDDLE, bend=bend))
    for y, start in product(np.linspace(-0.3, 0.3, 13), (-0.05, 0.0, 0.05)):
        wanted = reach([0.9, y, 0.6], start=(0.5, start, 0.5))
        middle = path(corrected, wanted)[wanted.trajectory.n_points // 2]
        assert abs(middle[1]) > 0.6 * abs(bend)


def test_how_the_hand_arrives_is_taken_to_objects_at_its_side(model, reach):
    """An object is to be reached for 3 cm beside where it is seen: so it is 10 cm further on."""
    arrived = reach(np.add(MIDDLE, [0.0, 0.03, 0.0]))
    corrected = model.updated(replace(arrived, origin=np.array(MIDDLE), condition=reach(MIDDLE).condition))
    for y in (-0.1, 0.1):
        wanted = reach(np.add(MIDDLE, [0.0, y, 0.0]))
        assert moved(model, corrected, wanted) > 0.5 * moved(model, corrected, reach(MIDDLE))


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
    for bend in (0.1, 0.2, -0.1, 0.05, -0.2):
        model = model.updated(reach(MIDDLE, bend=bend))
    assert len(model.corrections) == 3
    assert gap(model, reach(MIDDLE, bend=-0.2)) < 0.01


def test_a_condition_of_another_dimension_is_refused(model):
    with pytest.raises(WrongShape):
        model.updated(straight([0.1, 0.2]))
    with pytest.raises(WrongShape):
        model.predict(straight([0.1, 0.2]).situation)
    with pytest.raises(WrongShape):
        model.distribution(straight([0.1, 0.2]).situation)
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


@pytest.mark.parametrize("M", [2, 3, 5, 21, 26, 50, 100, 300])
def test_a_linear_family_is_met_within_a_millimetre_by_any_number_of_demonstrations(M):
    """Motions that swing out as far as their object stands aside."""
    model = AdaptiveProMP.fit([placed(y, side=y) for y in np.linspace(-0.2, 0.2, M)])
    for y in np.linspace(-0.2, 0.2, 9):
        wanted = placed(y, side=y)
        np.testing.assert_allclose(path(model, wanted), decoded(model, wanted), atol=0.001)


def test_the_size_of_an_object_beside_its_place_is_used():
    """In metres too, it differs by far less than places do."""
    rng = np.random.default_rng(5)
    demonstrations = [placed(y, size) for y, size in rng.uniform([-0.3, 0.01], [0.3, 0.05], size=(8, 2))]
    model = AdaptiveProMP.fit(demonstrations)
    for size in (0.015, 0.045):
        np.testing.assert_allclose(path(model, placed(0.1, size)), decoded(model, placed(0.1, size)), atol=0.003)


@pytest.mark.parametrize("kept", [[0], [1], [0, 1]])
def test_a_dimension_that_never_varied_makes_no_difference_and_is_not_known_where_it_differs(kept):
    same = [placed(y, 0.03) for y in (-0.2, 0.0, 0.25)]
    model = AdaptiveProMP.fit(same[: 1 + max(kept)])
    usual, other = placed(0.0, 0.03), placed(0.0, 0.08)
    np.testing.assert_allclose(path(model, other), path(model, usual), atol=1e-12)
    assert predict(model, other).known == 0.0
    taught = model.updated(placed(0.0, 0.08))
    assert gap(taught, placed(0.0, 0.08)) < 0.002
    assert predict(taught, other).known > 0.9


def test_the_deviation_falls_as_corrections_agree():
    """What a motion repeats to is only half of it: the other half is averaged out."""
    model = AdaptiveProMP.fit([placed(-0.2), placed(0.2)])
    deviations = []
    for _ in range(8):
        model = model.updated(placed(0.0, side=0.15))
        deviations.append(standard_deviation(model, placed(0.0)))
    assert (np.diff(deviations) < 0.0).all()
    assert deviations[-1] < 0.85 * deviations[0]


def test_corrections_that_scatter_leave_more_deviation_than_those_that_agree():
    def after(spread):
        model = AdaptiveProMP.fit([placed(-0.2), placed(0.2)])
        for side in (0.15 - spread, 0.15 + spread, 0.15 - spread, 0.15 + spread):
            model = model.updated(placed(0.0, side=side))
        return standard_deviation(model, placed(0.0))

    assert after(0.02) > 1.3 * after(0.001)


def test_a_changed_world_is_followed_at_the_first_correction_also_after_noisy_ones():
    model = AdaptiveProMP.fit([placed(-0.2), placed(0.2)])
    for side in 0.15 + 0.01 * np.random.default_rng(3).normal(size=6):
        model = model.updated(placed(0.0, side=side))
    changed = placed(0.0, side=-0.15)
    assert gap(model.updated(changed), changed) < 0.04 * gap(model, changed)


def believed(alpha):
    model = AdaptiveProMP.fit([placed(-0.2), placed(0.2)])
    told = replace(placed(0.0, side=0.2), provenance=Provenance(confidence=alpha))
    return path(model.updated(told), told) - path(model, told)


def test_a_correction_counts_as_far_as_it_is_believed():
    np.testing.assert_allclose(believed(0.5), 0.5 * believed(1.0), atol=0.002)
    np.testing.assert_allclose(believed(0.0), 0.0, atol=0.002)


def test_the_time_of_a_correction_is_kept():
    told = replace(placed(0.0, side=0.2), provenance=Provenance(at_s=1234.5))
    assert AdaptiveProMP.fit([placed(0.1)]).updated(told).corrections.held[0].at_s == 1234.5


def test_the_extent_is_the_root_mean_square_of_how_far_motions_lead():
    model = AdaptiveProMP.fit([placed(0.0), placed(0.3)])
    squares = [0.4**2 + 0.1**2, 0.4**2 + 0.3**2 + 0.1**2]
    assert model.corrections.extent == pytest.approx(np.sqrt(np.mean(squares)))
    still = placed(0.0)
    still = replace(still, trajectory=replace(still.trajectory, positions=0.0 * still.trajectory.positions))
    assert AdaptiveProMP.fit([still]).corrections.extent == 1.0


def test_of_many_demonstrations_near_ones_are_averaged():
    demonstrations = [placed(y, duration=4.0 + i) for i, y in enumerate((-0.2, 0.2, 0.19, -0.19))]
    model = AdaptiveProMP.fit(demonstrations, AdaptiveOptions(most=2))
    np.testing.assert_allclose(model.corrections.regression.conditions[:, 1], [-0.195, 0.195])


def test_before_any_correction_the_variance_is_that_of_the_spread_and_of_what_is_expected():
    model = AdaptiveProMP.fit([placed(y, side=0.02 * i) for i, y in enumerate((-0.2, -0.1, 0.1, 0.25))])
    wanted = placed(0.05)
    relative = model.corrections.regression.uncertainty(model.corrections.regression.at(wanted.condition))
    prediction = predict(model, wanted)
    np.testing.assert_allclose(prediction.position_covariances, relative * model.spread.positions(30), atol=1e-15)
    duration = np.sqrt(relative * model.spread.covariance[-1, -1])
    assert prediction.duration_std == pytest.approx(prediction.trajectory.duration * duration)


@pytest.mark.parametrize("count", [1, 4])
def test_at_corrections_that_agree_the_variance_is_by_hand(count):
    """What is open, what a motion repeats to (half averaged out), how corrections scatter, and what may change."""
    model = AdaptiveProMP.fit([placed(-0.2), placed(0.2)])
    for _ in range(count):
        model = model.updated(placed(0.05, side=0.2, duration=6.0))
    corrections, spread = model.corrections, model.spread
    expected = corrections.regression.at(placed(0.05).condition)
    effect = corrections.effect(expected)
    left, change = effect.open_share, model.encoding.positions(corrections.changes[:1], 30)[0]
    repeated = 0.05 * (0.5 + 0.5 / count)
    scattered = corrections.noise / count / spread.mean_square
    taught = left * corrections.regression.uncertainty(expected) + (1.0 - left) * (repeated + scattered)
    changed = left * effect.surprise / corrections.mean_square * change[:, :, None] * change[:, None]
    prediction = predict(model, placed(0.05))
    covariances = taught * spread.positions(30) + changed
    np.testing.assert_allclose(prediction.position_covariances, covariances, rtol=1e-6, atol=1e-12)
    duration = taught * spread.covariance[-1, -1] + left * effect.surprise / corrections.mean_square * np.mean(
        corrections.changes[:, -1] ** 2
    )
    assert prediction.duration_std == pytest.approx(prediction.trajectory.duration * np.sqrt(duration))


def test_nothing_to_learn_from_is_refused():
    with pytest.raises(TooFewDemonstrations):
        AdaptiveProMP.fit([])


@pytest.mark.parametrize("aside", [[0.0, 0.0, -0.05], [0.05, 0.0, 0.0]])
def test_a_start_that_was_never_shown_comes_back_to_the_corrected_way_soon(model, reach, aside):
    correction = reach(MIDDLE, bend=0.2)
    corrected, n = model.updated(correction), 101
    situation = replace(correction.situation, start_position=correction.situation.start_position + aside)
    away = corrected.predict(situation, n).trajectory.positions - predict(corrected, correction, n).trajectory.positions
    np.testing.assert_allclose(away[0], aside, atol=1e-12)
    assert np.linalg.norm(away[38:], axis=1).max() < 0.1 * np.linalg.norm(aside)
