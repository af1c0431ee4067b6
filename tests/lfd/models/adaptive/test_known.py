"""How much is known of a motion, and which of several ways it takes."""

from dataclasses import replace

import numpy as np
import pytest

from lfd.models.adaptive.adaptation import AdaptiveProMP
from tests.lfd.models.adaptive.motions import path, placed, predict


def test_everything_is_known_at_a_demonstration_and_at_a_correction_and_less_and_less_beyond():
    model = AdaptiveProMP.fit([placed(y) for y in (-0.2, -0.1, 0.0, 0.1)])
    assert predict(model, placed(0.1)).known == pytest.approx(1.0)
    known = [predict(model, placed(y)).known for y in (0.1, 0.15, 0.3, 0.6, 2.0)]
    assert (np.diff(known) < 0.0).all()
    assert known[-1] < 0.05
    corrected = model.updated(placed(2.0, side=0.2))
    assert predict(corrected, placed(2.0)).known > 0.99


def test_how_much_is_known_falls_as_the_detail_of_a_place_does():
    """exp(-d / near), d beyond the conditions shown."""
    model = AdaptiveProMP.fit([placed(y) for y in (-0.2, 0.2)])
    wanted = placed(0.7)
    outside = model.corrections.regression.at(wanted.condition).outside
    near = model.options.correction.covariance.near
    assert predict(model, wanted).known == pytest.approx(np.exp(-np.linalg.norm(outside) / near))


def test_far_along_what_only_a_correction_varied_little_is_known():
    """One demonstration gives a number that is no place no unit: it is not known everywhere once it was corrected."""

    def turned(angle, side=0.0):
        return replace(placed(0.0, side=side), condition=np.array([angle]))

    model = AdaptiveProMP.fit([turned(0.0)]).updated(turned(0.2, side=0.2))
    known = [predict(model, turned(angle)).known for angle in (0.0, 0.2, 0.4, 4.0)]
    assert known[0] == pytest.approx(1.0)
    assert known[1] > 0.99
    assert known[2] < 0.9
    assert known[3] < 0.05


@pytest.fixture(scope="module")
def round_a_thing():
    """A post stands at the middle: it was passed on the left once and on the right once, 20 cm apart."""
    model = AdaptiveProMP.fit([placed(-0.2), placed(0.2)])
    return model.updated(placed(-0.1, side=-0.15)).updated(placed(0.1, side=0.15))


def test_between_left_and_right_it_is_one_of_them_and_never_the_middle(round_a_thing):
    for y in np.linspace(-0.1, 0.1, 17):
        side = path(round_a_thing, placed(y))[:, 1] - path(AdaptiveProMP.fit([placed(0.1)]), placed(y))[:, 1]
        most = side[np.abs(side).argmax()]
        assert 0.75 * 0.15 < abs(most) < 1.25 * 0.15


def test_halfway_nothing_is_known_and_the_deviation_is_half_of_what_lies_between(round_a_thing):
    halfway = predict(round_a_thing, placed(0.0))
    assert halfway.way.probability == pytest.approx(0.5, abs=1e-6)
    assert halfway.known == pytest.approx(0.0, abs=1e-6)
    assert np.sqrt(halfway.position_covariances[:, 1, 1].max()) >= 0.15
    deviations = round_a_thing.distribution(placed(0.0).situation).position_covariances(75)[:, 1, 1]
    assert np.sqrt(deviations.max()) >= 0.15


def test_at_its_corrections_a_way_is_known(round_a_thing):
    at_one = predict(round_a_thing, placed(0.1))
    assert at_one.way.count == 2
    assert at_one.way.probability > 0.95
    assert at_one.known > 0.9
