"""What the analyses compare differs by one thing at a time."""

import numpy as np
import pytest

from lfd.motion.demonstration import Situation
from services.model.learning import MODELS
from services.reproduction.models import ANCHORED, BY_NAME, COARSE, CONTENDERS, DEFAULT, FINE, PRIMITIVE, THESIS
from services.reproduction.scripted import demonstrate
from sim.tasks import TABLE

ASIDE = np.array([0.0, 0.05, 0.02])


@pytest.fixture(scope="module")
def demonstrations():
    rng = np.random.default_rng(0)
    return [demonstrate(TABLE, place, rng) for place in TABLE.training_positions]


def moved(demonstration):
    """The situation of a demonstration, begun aside of it; the condition is as it was."""
    known = demonstration.situation
    return Situation(known.condition, known.origin, known.start_position + ASIDE, known.start_orientation)


def starts_off(contender, demonstrations):
    situation = moved(demonstrations[0])
    first = contender.fit(demonstrations).predict(situation).trajectory.positions[0]
    return float(np.linalg.norm(first - situation.start_position))


def test_names_and_labels_tell_them_apart_and_the_services_own_are_among_them():
    assert len(BY_NAME) == len(CONTENDERS) == len({contender.label for contender in CONTENDERS})
    assert MODELS.keys() <= BY_NAME.keys()


@pytest.mark.parametrize("contender", [one for one in CONTENDERS if one is not THESIS], ids=lambda one: one.name)
def test_all_but_the_thesis_model_begin_at_the_start_pose(contender, demonstrations):
    assert starts_off(contender, demonstrations) < 1e-9
    assert starts_off(THESIS, demonstrations) > 0.04


def test_models_of_one_resolution_have_as_many_functions_and_samples(demonstrations):
    coarse = [contender.fit(demonstrations).encoding for contender in (THESIS, ANCHORED, COARSE)]
    fine = [contender.fit(demonstrations).encoding for contender in (FINE, DEFAULT)]
    for encodings in (coarse, fine):
        assert len({(encoding.basis, encoding.samples) for encoding in encodings}) == 1
    assert coarse[0].basis != fine[0].basis


@pytest.mark.parametrize("contender", CONTENDERS, ids=lambda one: one.name)
def test_an_update_leaves_the_older_model_as_it_was(contender, demonstrations):
    situation = demonstrations[1].situation
    model = contender.fit(demonstrations[:1])
    before = model.predict(situation).trajectory.positions
    updated = model.updated(demonstrations[1])
    np.testing.assert_array_equal(model.predict(situation).trajectory.positions, before)
    assert np.abs(updated.predict(situation).trajectory.positions - before).max() > 1e-3


def test_a_primitive_is_led_to_the_object_as_its_own_motion_was(demonstrations):
    shown = demonstrations[0]
    model = PRIMITIVE.fit([shown])
    there = shown.origin + np.array([0.1, -0.05, 0.02])
    start = shown.trajectory.positions[0], shown.trajectory.orientations[0]
    ended = model.predict(Situation.reaching(there, *start)).trajectory
    np.testing.assert_allclose(ended.positions[-1] - there, shown.trajectory.positions[-1] - shown.origin, atol=1e-4)


def test_the_newest_of_several_motions_of_one_condition_predicts(demonstrations):
    first, other = demonstrations[:2]
    newer = type(other)(
        other.trajectory, first.origin + other.trajectory.positions[0] - first.trajectory.positions[0], first.condition
    )
    model = PRIMITIVE.fit([first]).updated(newer)
    n = newer.trajectory.n_points
    predicted = model.predict(newer.situation, n).trajectory.positions
    alone = PRIMITIVE.fit([newer]).predict(newer.situation, n).trajectory.positions
    np.testing.assert_allclose(predicted, alone, atol=1e-12)


def test_a_primitive_s_distribution_is_its_prediction(demonstrations):
    model, situation = PRIMITIVE.fit(demonstrations), moved(demonstrations[1])
    predicted = model.predict(situation, 50).trajectory.positions
    np.testing.assert_allclose(model.distribution(situation).trajectory(50).positions, predicted, atol=2e-3)
