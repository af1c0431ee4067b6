"""What every movement model keeps to, whatever the external state is."""

import numpy as np
import pytest

from lfd.exceptions import WrongShape
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
