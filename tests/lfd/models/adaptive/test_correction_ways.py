"""Corrections that contradict each other side by side are several ways."""

import numpy as np
import pytest

from lfd.models.adaptive.correction import CorrectionOptions
from lfd.models.adaptive.kinds import ORIENTATION, POSITION
from lfd.models.model import ONLY_WAY
from tests.lfd.models.adaptive.vectors import KINDS, along, correct, effect, sized

OPTIONS = CorrectionOptions()
HERE = np.array([0.05, 0.1])


@pytest.fixture
def round_a_thing(none):
    """Left and right at neighbouring conditions, in units of the scale 0.2 apart."""
    left = correct(none, [-0.1, 0.0], sized(POSITION, 0.3))
    return correct(left, [0.1, 0.0], sized(POSITION, -0.25))


def test_left_and_right_are_two_ways_and_never_the_middle(round_a_thing):
    for x in np.linspace(-0.1, 0.1, 41):
        told = effect(round_a_thing, [x, 0.0])
        size = along(told.change, POSITION)
        assert min(abs(size - 0.3) / 0.3, abs(size + 0.25) / 0.25) < 0.25
        assert told.way.index == int(size < 0.0)
        assert told.way.count == 2


def test_halfway_either_way_is_as_probable(round_a_thing):
    told = effect(round_a_thing, [0.0, 0.0])
    assert told.way.probability == pytest.approx(0.5)
    ((probability, difference),) = told.others
    assert probability == pytest.approx(0.5)
    other = effect(round_a_thing, [0.001, 0.0]) if told.way.index == 0 else effect(round_a_thing, [-0.001, 0.0])
    np.testing.assert_allclose(told.change + difference, other.change, rtol=0.01)


def test_a_way_is_the_more_probable_the_nearer_its_corrections(round_a_thing):
    """A softmax of the distances to the nearest, by the gate."""
    for x in (-0.1, -0.05, 0.03, 0.1):
        gap = abs(abs(x + 0.1) - abs(x - 0.1))
        assert effect(round_a_thing, [x, 0.0]).way.probability == pytest.approx(1.0 / (1.0 + np.exp(-gap / 0.05)))


def test_a_way_that_is_improbable_is_not_spoken_of(none):
    far = correct(correct(none, [-0.15, 0.0], sized(POSITION, 0.3)), [0.15, 0.0], sized(POSITION, -0.3))
    assert effect(far, [-0.15, 0.0]).others == ()
    assert len(effect(far, [-0.1, 0.0]).others) == 1


def test_one_that_fits_a_way_joins_it(round_a_thing):
    third = correct(round_a_thing, [0.1, 0.15], sized(POSITION, 0.2))
    told = effect(third, [0.1, 0.15])
    assert (told.way.index, told.way.count) == (0, 2)


def test_what_no_longer_holds_is_no_way(none):
    """A world that changed at one condition is followed, not offered as another way."""
    turned = correct(correct(none, HERE, sized(POSITION, 0.3)), HERE, sized(POSITION, -0.3))
    assert effect(turned, HERE).way == ONLY_WAY


def test_an_orientation_that_still_holds_goes_the_way_of_what_is_nearest(none):
    """To the right now instead of to the left, rolled as before; beside it the way is still to the left."""
    there = [0.3, 0.1]
    held = correct(none, HERE, sized(POSITION, 0.3) + sized(ORIENTATION, 0.40))
    held = correct(held, HERE, sized(POSITION, -0.3) + sized(ORIENTATION, 0.42))
    held = correct(held, there, sized(POSITION, 0.3))
    told = effect(held, HERE)
    columns = KINDS.columns[ORIENTATION]
    assert (told.way.index, told.way.count) == (0, 2)
    np.testing.assert_allclose(told.change[columns], sized(ORIENTATION, 0.41)[columns], rtol=0.005)
    np.testing.assert_allclose(effect(held, there).change[columns], 0.0, atol=0.01)
