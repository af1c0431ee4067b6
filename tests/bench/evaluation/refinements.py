"""What a model predicts before and after people's corrections, their own and somebody else's."""

from dataclasses import dataclass

import numpy as np

from tests.bench.baselines.models import MODELS
from tests.bench.evaluation.left_out import SAME_CONDITION


@dataclass(frozen=True)
class Adaptation:
    """One model on one sequence: the gap before and after each update [m]."""

    model: str
    sequence: str
    before: tuple[float, ...]
    after: tuple[float, ...]

    @property
    def left(self):
        return [after / before for before, after in zip(self.before, self.after, strict=True)]


@dataclass(frozen=True)
class Transfer:
    """One model: the share of a person's first gaps that is left after corrections by others [-].

    Attributes:
        model: By its name.
        taught: ONE correction by another person, at the same condition, or the first ones of EVERYBODY else.
        pairs: Shares counted: of pairs of corrections, or of a person's own and those of everybody else.
        median: Of the shares left; above 1 the prediction is worse than before.
        nine_in_ten: Nine in ten shares are at most this.
        worse: How many of the shares are above 1 [-].
    """

    model: str
    taught: str
    pairs: int
    median: float
    nine_in_ten: float
    worse: float


ONE, EVERYBODY = "one correction", "everybody else's"


def gap(model, wanted):
    """Root mean square distance of the prediction from a motion, at equal times [m]."""
    predicted = model.predict(wanted.situation, wanted.trajectory.n_points).trajectory.positions
    return float(np.sqrt(np.mean(np.sum((predicted - wanted.trajectory.positions) ** 2, axis=1))))


def adapt(name, initial, sequence):
    """A sequence replayed from the initial demonstrations, in its order."""
    model = MODELS[name].fit(initial)
    before, after = [], []
    for refinement in sequence.refinements:
        before.append(gap(model, refinement))
        model = model.updated(refinement)
        after.append(gap(model, refinement))
    return Adaptation(name, sequence.name, tuple(before), tuple(after))


def transfer(name, initial, sequences):
    """What first corrections of each sequence do for other persons; nothing where there are none to be compared.

    Only first ones: what comes later answers a prediction that had learnt from its own operator already.
    """
    model = MODELS[name].fit(initial)
    firsts = [(s.operator, s.refinements[0], gap(model, s.refinements[0])) for s in sequences]
    shares = {ONE: _after_one(model, firsts), EVERYBODY: _after_everybody(model, firsts)}
    return [_transfer(name, taught, np.array(left)) for taught, left in shares.items() if left]


def _after_one(model, firsts):
    left = []
    for teacher, correction, _ in firsts:
        taught = model.updated(correction)
        for operator, wanted, before in firsts:
            near = np.linalg.norm(wanted.condition - correction.condition) <= SAME_CONDITION
            if operator != teacher and near:
                left.append(gap(taught, wanted) / before)
    return left


def _after_everybody(model, firsts):
    left = []
    for operator in dict.fromkeys(operator for operator, _, _ in firsts):
        taught = model
        for teacher, correction, _ in firsts:
            taught = taught.updated(correction) if teacher != operator else taught
        if taught is not model:
            left += [gap(taught, wanted) / before for own, wanted, before in firsts if own == operator]
    return left


def _transfer(name, taught, left):
    worse = float(np.mean(left > 1.0))
    return Transfer(name, taught, len(left), float(np.median(left)), float(np.quantile(left, 0.9)), worse)
