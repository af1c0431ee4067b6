"""What the learning benchmark counts, on models whose errors are known."""

from dataclasses import dataclass

import numpy as np
import pytest

from lfd.motion.demonstration import Demonstration
from lfd.motion.trajectory import Trajectory
from tests.bench.baselines import models
from tests.bench.baselines.models import BASELINES, DEFAULT, MODELS, THESIS
from tests.bench.evaluation.left_out import LeftOut, leave_out
from tests.bench.evaluation.parts import Part, Recordings
from tests.bench.evaluation.refinements import EVERYBODY, ONE, Adaptation, adapt, transfer
from tests.bench.evaluation.summary import bests, figures, means, next_gaps
from tests.recordings import Sequence

ORIENTATIONS = np.tile([1.0, 0.0, 0.0, 0.0], (20, 1))


def motion(height, y=0.0):
    """A straight motion along x at a height, to an object beside its start."""
    positions = np.column_stack([np.linspace(0.0, 1.0, 20), np.zeros(20), np.full(20, height)])
    return Demonstration(Trajectory(positions, ORIENTATIONS, 1.0), np.zeros(3), np.array([y, 0.0, 0.0]))


@dataclass(frozen=True)
class Halfway:
    """Goes half the way from what it expected to each new motion; sure to a centimetre."""

    height: float

    @classmethod
    def fit(cls, demonstrations):
        return cls(float(np.mean([_height(d) for d in demonstrations])))

    def updated(self, demonstration):
        return Halfway(0.5 * (self.height + _height(demonstration)))

    def predict(self, _situation, n):
        return _Predicted(motion(self.height).trajectory, np.tile(1e-4 * np.eye(3), (n, 1, 1)))


@dataclass(frozen=True)
class _Predicted:
    trajectory: Trajectory
    position_covariances: np.ndarray


def _height(demonstration):
    return demonstration.trajectory.positions[0, 2]


@pytest.fixture
def halfway(monkeypatch):
    monkeypatch.setitem(models.MODELS, "halfway", Halfway)
    return "halfway"


def test_a_sequence_is_replayed_in_order(halfway):
    sequence = Sequence("A", "by hand", "1", (motion(1.0), motion(2.0)))
    adaptation = adapt(halfway, [motion(0.0)], sequence)
    assert adaptation.before == pytest.approx((1.0, 1.5))
    assert adaptation.after == pytest.approx((0.5, 0.75))
    assert adaptation.left == pytest.approx([0.5, 0.5])


def test_only_the_gaps_before_later_corrections_are_those_before_the_next():
    adaptations = [Adaptation(DEFAULT, "A", (1.0, 2.0, 3.0), (0.1,) * 3), Adaptation(DEFAULT, "B", (5.0,), (0.1,))]
    assert next_gaps(adaptations, DEFAULT) == pytest.approx([2.0, 3.0])


def test_a_correction_is_transferred_to_others_at_its_condition_alone(halfway):
    sequences = [
        Sequence("A", "by hand", "1", (motion(2.0), motion(50.0))),
        Sequence("A", "by hand", "2", (motion(40.0),)),
        Sequence("B", "by hand", "1", (motion(1.0),)),
        Sequence("C", "by hand", "1", (motion(-1.0, y=1.0),)),
    ]
    found = next(t for t in transfer(halfway, [motion(0.0)], sequences) if t.taught == ONE)
    # From 0: A's 2 and 40 lead to 1 and 20, where B wanted 1; B's 1 to 0.5, where A wanted 2 and 40.
    left = [0.0, 19.0, 1.5 / 2.0, 39.5 / 40.0]
    assert found.pairs == 4
    assert found.median == pytest.approx(np.median(left))
    assert found.worse == 0.25


def test_nobody_else_is_nothing_to_transfer(halfway):
    assert transfer(halfway, [motion(0.0)], [Sequence("A", "by hand", "1", (motion(2.0),))]) == []


def test_everybody_else_teaches_in_the_order_of_the_recordings(halfway):
    heights = {"A": 2.0, "B": 4.0, "C": -2.0}
    sequences = [Sequence(person, "by hand", "1", (motion(height),)) for person, height in heights.items()]
    found = next(t for t in transfer(halfway, [motion(0.0)], sequences) if t.taught == EVERYBODY)
    # From 0: B and C lead to 0, where A wanted 2; A and C to -0.5, where B wanted 4; A and B to 2.5, where C wanted -2.
    assert found.pairs == 3
    assert found.median == pytest.approx(np.median([2.0 / 2.0, 4.5 / 4.0, 4.5 / 2.0]))


def test_all_motions_of_a_condition_are_left_out_together(halfway):
    row = leave_out(halfway, "set", [motion(0.0), motion(1.0, y=0.001), motion(2.0, y=1.0), motion(3.0, y=1.001)])
    assert (row.conditions, row.demonstrations) == (2, 4)
    assert row.time == pytest.approx(np.mean([2.5, 1.5, 1.5, 2.5]))
    assert row.end == pytest.approx(row.time)
    assert row.coverage == pytest.approx(2.0 / 3.0)  # x and y are exact, z never is


def test_one_condition_cannot_be_left_out(halfway):
    assert leave_out(halfway, "set", [motion(0.0), motion(1.0)]) is None


def test_parts_share_no_set_and_no_person_and_leave_nothing_out():
    sequences = [Sequence(person, "by hand", "1", (motion(0.0),)) for person in "EADCB"]
    every = Recordings({name: [] for name in "zxy"}, sequences)
    tune, report = every.part(Part.TUNE), every.part(Part.REPORT)
    assert (list(tune.sets), tune.operators) == (["x"], ["A", "B"])
    assert (list(report.sets), report.operators) == (["y", "z"], ["C", "D", "E"])
    assert len(every.part(Part.ALL).sequences) == len(tune.sequences) + len(report.sequences)


def rows(errors, name="set", conditions=6):
    """Of each model, the error of those that are named, 1 m of all others."""
    return [LeftOut(m, name, conditions, 6, *[errors.get(m, 1.0)] * 3, 0.9) for m in MODELS]


def test_the_default_is_measured_by_the_best_baseline_of_each_set():
    (best,) = bests(rows({DEFAULT: 0.51, "kmp": 0.5, THESIS: 0.6}), "time")
    assert (best.best_model, best.ratio) == ("kmp", pytest.approx(1.02))


def test_the_mean_is_measured_by_the_best_single_baseline():
    left_out = rows({DEFAULT: 0.4, "kmp": 0.2, THESIS: 0.5}, "a") + rows(
        {DEFAULT: 0.4, "tp-gmm": 0.2, THESIS: 0.5}, "b"
    )
    figure = next(f for f in figures([], [], left_out) if f.name == "left-out time error, mean of the sets")
    assert (figure.best_model, figure.default, figure.best) == (THESIS, pytest.approx(0.4), pytest.approx(0.5))
    assert figure.met


def test_sets_of_two_conditions_are_told_apart():
    left_out = rows({DEFAULT: 0.4}, "several") + rows({DEFAULT: 0.2}, "two", conditions=2)
    default = next(m for m in means(left_out) if m.model == DEFAULT)
    assert (default.time, default.time_of_several) == (pytest.approx(0.3), pytest.approx(0.4))


def test_every_model_but_the_default_is_a_baseline():
    assert {*BASELINES, DEFAULT} == set(MODELS)


def test_the_coverage_of_the_worst_set_is_the_one_farthest_from_what_is_promised():
    left_out = []
    for name, conditions, coverage in (("a", 6, 0.93), ("b", 7, 0.86), ("few", 4, 0.1)):
        left_out += [LeftOut(m, name, conditions, 6, 1.0, 1.0, 1.0, coverage) for m in MODELS]
    worst = next(f for f in figures([], [], left_out) if "worst set of 6" in f.name)
    assert (worst.default, worst.met) == (0.86, True)
