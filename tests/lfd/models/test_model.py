"""What every movement model keeps to, whatever the external state is."""

from dataclasses import replace

import numpy as np
import pytest

from lfd.exceptions import EmptyPart, PartialDemonstration, WrongShape
from lfd.models.adaptive.adaptation import AdaptiveProMP
from lfd.models.promp import ConditionedProMP
from lfd.motion.demonstration import Demonstration, Situation
from lfd.motion.trajectory import Trajectory

MODEL = pytest.mark.parametrize("kind", [AdaptiveProMP, ConditionedProMP])
UPRIGHT = np.array([1.0, 0.0, 0.0, 0.0])


def passing(s):
    """A motion along x whose y is a linear function of a condition of any dimension."""
    t = np.linspace(0.0, 1.0, 60)
    y = sum(value * np.sin(np.pi * (k + 1) * t / 2.0) ** 2 for k, value in enumerate(s))
    positions = np.column_stack([0.4 * t, y, np.zeros(60)])
    return Demonstration(Trajectory(positions, np.tile(UPRIGHT, (60, 1)), 10.0), np.zeros(3), np.asarray(s, float))


@MODEL
@pytest.mark.parametrize("c", [1, 2, 4])
def test_a_correction_at_a_condition_of_any_dimension_brings_the_prediction_to_it(kind, c):
    model = kind.fit([passing(np.zeros(c))])
    wanted = passing(np.linspace(0.1, -0.1, c + 1)[:c])
    for _ in range(30):
        model = model.updated(wanted)
    predicted = model.predict(wanted.situation, 60).trajectory.positions
    np.testing.assert_allclose(predicted, wanted.trajectory.positions, atol=5e-3)


@MODEL
def test_a_condition_of_another_dimension_is_refused(kind):
    model = kind.fit([passing([0.0, 0.0]), passing([0.1, 0.0])])
    with pytest.raises(WrongShape, match="condition"):
        model.predict(Situation(np.zeros(3), np.zeros(3), np.zeros(3), UPRIGHT))
    with pytest.raises(WrongShape, match="condition"):
        model.updated(passing([0.1, 0.1, 0.1]))
    with pytest.raises(WrongShape, match="condition"):
        kind.fit([passing([0.0, 0.0]), passing([0.1, 0.0, 0.0])])


@pytest.mark.parametrize(("kind", "updates", "within"), [(AdaptiveProMP, 1, 1e-3), (ConditionedProMP, 8, 0.015)])
@pytest.mark.parametrize("part", [(0.0, 0.5), (0.3, 0.6), (0.5, 1.0)])
def test_a_correction_of_a_part_leaves_the_rest_as_predicted(kind, updates, within, part):
    """As closely as the model learns at all: the thesis' averages, and its basis is coarse."""
    model = kind.fit([passing([0.0])])
    wanted = replace(passing([0.1]), condition=np.zeros(1), part=part)
    before = model.predict(wanted.situation, 60).trajectory.positions
    for _ in range(updates):
        model = model.updated(wanted)
    after = model.predict(wanted.situation, 60).trajectory
    inside = (after.phases >= part[0] + 0.05) & (after.phases <= part[1] - 0.05)
    beyond = (after.phases < part[0] - 0.2) | (after.phases > part[1] + 0.2)
    np.testing.assert_allclose(after.positions[inside], wanted.trajectory.positions[inside], atol=within)
    np.testing.assert_allclose(after.positions[beyond], before[beyond], atol=within)
    assert np.abs(wanted.trajectory.positions - before)[beyond].max() > 0.018


@MODEL
def test_what_an_aborted_correction_did_after_its_part_is_not_learnt(kind):
    model = kind.fit([passing([0.0])])
    given = passing([0.1])
    positions = given.trajectory.positions.copy()
    positions[30:] = positions[29]
    aborted = replace(given, trajectory=replace(given.trajectory, positions=positions), part=(0.0, 0.45))
    whole = replace(given, part=(0.0, 0.45))
    one, two = (model.updated(update).predict(given.situation).trajectory for update in (aborted, whole))
    np.testing.assert_allclose(one.positions, two.positions, atol=1e-12)


@MODEL
def test_a_model_begins_with_whole_motions(kind):
    with pytest.raises(PartialDemonstration, match="whole"):
        kind.fit([replace(passing([0.0]), part=(0.0, 0.5))])


def test_a_demonstration_of_no_part_is_refused():
    with pytest.raises(EmptyPart, match="empty"):
        replace(passing([0.0]), part=(0.5, 0.5))
