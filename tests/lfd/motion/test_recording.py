"""What other libraries hold as arrays becomes demonstrations; what does not fit is refused by name and index."""

import numpy as np
import pytest

from lfd.exceptions import (
    NotFinite,
    NotNumbers,
    NotUnitQuaternion,
    TimesNotIncreasing,
    TooFewDemonstrations,
    TooFewPoints,
    WrongShape,
)
from lfd.models.adaptive.adaptation import AdaptiveProMP
from lfd.models.promp import ConditionedProMP
from lfd.motion.demonstration import Demonstration
from lfd.motion.provenance import Provenance
from lfd.motion.recording import demonstration_from_arrays, demonstrations_from_arrays, situation_from_arrays
from lfd.motion.rotations import exp_map
from lfd.motion.trajectory import Trajectory

N, T, C = 4, 20, 2
TIMES = np.linspace(3.0, 5.0, T)
CONDITIONS = np.arange(N * C, dtype=float).reshape(N, C)


def paths(d=3):
    phase = np.linspace(0.0, 1.0, T)[:, None]
    return np.array([phase * np.arange(1.0, d + 1.0) + 0.1 * i * np.sin(np.pi * phase) for i in range(N)])


@pytest.mark.parametrize("d", [1, 2, 3])
def test_axes_that_are_not_there_are_zero(d):
    for made, given in zip(demonstrations_from_arrays(TIMES, paths(d), CONDITIONS), paths(d), strict=True):
        np.testing.assert_allclose(made.trajectory.positions[:, :d], given, atol=1e-12)
        assert not made.trajectory.positions[:, d:].any()
        assert made.trajectory.duration == pytest.approx(2.0)


def test_one_motion_alone_is_as_among_several():
    turns = exp_map(np.linspace(0.0, 1.0, T)[:, None] * [0.1, 0.2, 0.3])
    whose = Provenance("anna", 5.0, 0.5)
    several = demonstrations_from_arrays(
        TIMES, paths(), CONDITIONS, [turns] * N, np.arange(3.0 * N).reshape(N, 3), provenance=whose
    )
    alone = demonstration_from_arrays(TIMES, paths()[1], CONDITIONS[1], turns, [3.0, 4.0, 5.0], provenance=whose)
    for name in ("positions", "orientations"):
        np.testing.assert_array_equal(getattr(several[1].trajectory, name), getattr(alone.trajectory, name))
    np.testing.assert_array_equal(several[1].origin, alone.origin)
    np.testing.assert_array_equal(several[1].condition, alone.condition)
    assert several[1].provenance == alone.provenance == whose


def test_motions_of_different_lengths_and_times_are_sequences():
    lengths = [5, 9, 30]
    made = demonstrations_from_arrays(
        [np.linspace(0.0, n, n) for n in lengths], [np.ones((n, 2)).cumsum(axis=0) for n in lengths], [1, 2, 3]
    )
    assert [one.trajectory.n_points for one in made] == lengths
    assert [one.trajectory.duration for one in made] == lengths


def test_samples_at_uneven_times_are_brought_to_even_ones():
    """Along a straight line at a constant speed positions are the times, whatever the intervals."""
    times = np.array([0.0, 0.1, 0.15, 0.7, 1.0])
    made = demonstration_from_arrays(times, times[:, None], 0.0)
    np.testing.assert_allclose(made.trajectory.positions[:, 0], np.linspace(0.0, 1.0, 5), atol=1e-12)


@pytest.mark.parametrize("kind", [AdaptiveProMP, ConditionedProMP])
@pytest.mark.parametrize("conditions", [np.arange(N), np.arange(N)[:, None], list(range(N))])
def test_a_number_is_a_condition_of_one_dimension(kind, conditions):
    model = kind.fit(demonstrations_from_arrays(TIMES, paths(), conditions))
    as_number, as_array = (model.predict(situation_from_arrays(s, [0.0, 0.0, 0.0])) for s in (1.5, [1.5]))
    np.testing.assert_array_equal(as_number.trajectory.positions, as_array.trajectory.positions)


@pytest.mark.parametrize("number", [2, 2.0, np.float64(2.0), np.array(2.0), np.int32(2)])
def test_any_number_is_a_condition(number):
    motion = Trajectory(np.eye(3), np.tile([1.0, 0.0, 0.0, 0.0], (3, 1)), 1.0)
    np.testing.assert_array_equal(Demonstration(motion, np.zeros(3), number).condition, [2.0])


def spoilt(i, at, value):
    changed = paths()
    changed[i][at] = value
    return changed


@pytest.mark.parametrize(
    ("given", "error", "facts"),
    [
        ((TIMES, [], []), TooFewDemonstrations, {}),
        ((TIMES, paths(), CONDITIONS[:3]), WrongShape, {"name": "conditions", "actual": (3,)}),
        ((TIMES, paths(), [[1.0], [1.0], [1.0, 2.0], [1.0]]), WrongShape, {"name": "conditions[2]", "actual": (2,)}),
        ((TIMES, paths(), [[1.0], [], [1.0], [1.0]]), WrongShape, {"name": "condition[1]", "actual": (0,)}),
        ((TIMES, paths(), [1.0, "left", 1.0, 1.0]), NotNumbers, {"name": "condition[1]"}),
        ((TIMES, paths(), [1.0, np.nan, 1.0, 1.0]), NotFinite, {"name": "condition[1]", "index": (0,)}),
        ((TIMES, paths(), None), NotNumbers, {"name": "conditions"}),
        ((TIMES, 5.0, CONDITIONS), NotNumbers, {"name": "positions"}),
        ((TIMES, paths()[0][:N], CONDITIONS), WrongShape, {"name": "positions[0]", "actual": (3,)}),
        ((TIMES, np.zeros((N, T, 4)), CONDITIONS), WrongShape, {"name": "positions[0]", "actual": (T, 4)}),
        ((TIMES, spoilt(2, (7, 1), np.nan), CONDITIONS), NotFinite, {"name": "positions[2]", "index": (7, 1)}),
        ((TIMES[:-1], paths(), CONDITIONS), WrongShape, {"name": "positions[0]", "actual": (T, 3)}),
        ((TIMES[::-1], paths(), CONDITIONS), TimesNotIncreasing, {"name": "times[0]", "index": 1}),
        ((TIMES.round(), paths(), CONDITIONS), TimesNotIncreasing, {"name": "times[0]", "index": 1}),
        ((np.tile(TIMES, (3, 1)), paths(), CONDITIONS), WrongShape, {"name": "times", "actual": (3,)}),
        ((TIMES[:1], paths()[:, :1], CONDITIONS), TooFewPoints, {"name": "positions[0]", "count": 1}),
        ((TIMES, [[[1.0, 2.0], [3.0]]] * N, CONDITIONS), NotNumbers, {"name": "positions[0]"}),
        ((TIMES, paths(), CONDITIONS, np.zeros((N, T, 4))), NotUnitQuaternion, {"name": "orientations[0]"}),
        ((TIMES, paths(), CONDITIONS, None, np.zeros(4)), WrongShape, {"name": "origin[0]", "actual": (4,)}),
    ],
)
def test_what_does_not_fit_is_refused_by_its_name_and_place(given, error, facts):
    with pytest.raises(error) as caught:
        demonstrations_from_arrays(*given)
    assert {name: getattr(caught.value, name) for name in facts} == facts
