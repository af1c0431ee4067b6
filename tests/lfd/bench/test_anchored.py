"""The simplest baselines, by what they are."""

import numpy as np
import pytest

from lfd.motion.demonstration import Situation
from tests.bench.baselines.anchored import AnchoredMean, AnchoredNearest
from tests.bench.baselines.anchored_promp import AnchoredProMP
from tests.bench.baselines.models import MODELS

PLACES = ([0.9, 0.3, 0.6], [0.9, 0.0, 0.6], [0.9, -0.3, 0.6])


@pytest.fixture(scope="module")
def demonstrations(reach):
    return [reach(place, bend=bend) for place, bend in zip(PLACES, (0.0, 0.1, 0.05), strict=True)]


def positions(model, situation, n=60):
    return model.predict(situation, n).trajectory.positions


def test_the_nearest_is_exact_at_a_condition_that_was_shown(demonstrations):
    model = AnchoredNearest.fit(demonstrations)
    for shown in demonstrations:
        assert positions(model, shown.situation) == pytest.approx(shown.trajectory.positions, abs=1e-3)


def test_the_mean_is_that_of_the_motions_left_of_a_straight_start(demonstrations):
    model = AnchoredMean.fit(demonstrations)
    situation = demonstrations[1].situation
    blend = np.linspace(1.0, 0.0, 60)[:, None]
    relative = [d.trajectory.positions - d.origin for d in demonstrations]
    left = np.mean([path - blend * path[0] for path in relative], axis=0)
    expected = situation.origin + left + blend * (situation.start_position - situation.origin)
    assert positions(model, situation) == pytest.approx(expected, abs=1e-3)


@pytest.mark.parametrize("kind", [AnchoredMean, AnchoredNearest])
def test_an_update_is_a_fit_of_all(kind, demonstrations):
    *first, last = demonstrations
    grown, whole = kind.fit(first).updated(last), kind.fit(demonstrations)
    for d in demonstrations:
        # But for the rotation about which orientations are linearised, which stays the first fit's.
        assert positions(grown, d.situation) == pytest.approx(positions(whole, d.situation), abs=1e-9)


def test_the_mean_s_variance_is_that_of_left_out_motions(demonstrations):
    model = AnchoredMean.fit(demonstrations)
    left_out = []
    for i, d in enumerate(demonstrations):
        rest = AnchoredMean.fit(demonstrations[:i] + demonstrations[i + 1 :])
        left_out.append(positions(rest, d.situation) - positions(AnchoredNearest.fit([d]), d.situation))
    variances = np.mean(np.array(left_out) ** 2, axis=0)
    prediction = model.predict(demonstrations[0].situation, 60)
    assert np.diagonal(prediction.position_covariances, axis1=1, axis2=2) == pytest.approx(variances, abs=1e-9)


def test_the_thesis_model_differs_by_its_start_alone(demonstrations):
    situation, aside = demonstrations[0].situation, np.array([0.0, 0.05, 0.0])
    start = situation.start_position + aside
    moved = Situation(situation.condition, situation.origin, start, situation.start_orientation)
    model = AnchoredProMP.fit(demonstrations)
    assert positions(model, moved)[0] == pytest.approx(moved.start_position, abs=1e-12)
    change = positions(model, moved) - positions(model, situation)
    assert change == pytest.approx(np.outer(np.linspace(1.0, 0.0, 60), aside), abs=1e-12)


@pytest.mark.parametrize("name", MODELS)
def test_a_model_of_one_demonstration_learns_and_leaves_the_old_as_it_was(name, demonstrations):
    situation = demonstrations[1].situation
    model = MODELS[name].fit(demonstrations[:1])
    before = positions(model, situation)
    after = positions(model.updated(demonstrations[1]), situation)
    assert np.array_equal(positions(model, situation), before)
    assert np.abs(after - before).max() > 0.01
