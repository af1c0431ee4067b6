"""Where an empty skill is to be shown a motion."""

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from services.station.workflow.guide import Guide
from services.station.workflow.proposals import places, proposed
from tests.services.station.workflow.site import BY_HAND, Site

SCENE = Site(BY_HAND).view.scene
coordinates = st.integers(0, 40).map(lambda number: number / 20)
training = st.lists(st.tuples(coordinates, coordinates, st.just(0.7)), min_size=1, max_size=8, unique=True)


def scene(*training_places, **changes):
    return msgspec.structs.replace(SCENE, training_places=training_places, **changes)


@given(training)
def test_whoever_passes_over_all_places_has_seen_each_once(training_places):
    them = scene(*training_places)
    seen = [proposed(them, Guide(passed=passed)).object_position for passed in range(len(training_places))]
    assert sorted(seen) == sorted(training_places)


@given(training)
def test_the_second_place_is_the_farthest_from_the_first(training_places):
    them = scene(*training_places)
    first, second = (np.array(proposed(them, Guide(kept=kept)).object_position) for kept in (0, 1))
    away = np.linalg.norm(np.array(training_places) - first, axis=1)
    assert len(training_places) == 1 or np.linalg.norm(second - first) == pytest.approx(np.max(away))


def test_where_a_motion_was_kept_within_what_the_eyes_err_by_none_is_shown_again():
    them = scene((0.5, 0.0, 0.7), (0.9, 0.0, 0.7))
    kept_at = ((0.9, 0.004, 0.7),)
    assert proposed(them, Guide(kept=1), kept_at).object_position == (0.5, 0.0, 0.7)
    everywhere = (*kept_at, (0.5, 0.0, 0.7))
    assert proposed(them, Guide(kept=2), everywhere).object_position in them.training_places


def test_a_condition_of_its_own_is_proposed_as_one():
    them = scene((0.0, 0.0), (0.1, 0.1), condition=(0.0, 0.0))
    chosen = proposed(them, Guide(kept=1), ((0.0, 0.0, 0.0),))
    assert (chosen.condition, chosen.object_position) == ((0.1, 0.1), None)


@pytest.mark.parametrize(("count", "shown"), [(0, 0), (1, 1), (2, 2), (4, 2)])
def test_a_skill_is_shown_at_two_places_where_its_task_has_as_many(count, shown):
    them = scene(*((0.1 * number, 0.0, 0.7) for number in range(count)))
    assert places(them) == shown
    assert (proposed(them, Guide()) is None) is (count == 0)
