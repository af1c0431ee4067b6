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
    """One model, over pairs of persons: the share of a gap that is left after somebody else's correction [-].

    Attributes:
        model: By its name.
        pairs: A first correction by one person, and one by another at the same condition, in that order.
        median: Of the shares left; above 1 the prediction is worse than before.
        nine_in_ten: Nine in ten shares are at most this.
        worse: How many of the shares are above 1 [-].
    """

    model: str
    pairs: int
    median: float
    nine_in_ten: float
    worse: float


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
    """The first corrections of each sequence, from one person to another; None where no two are to be compared.

    Only first ones: what comes later answers a prediction that had learnt from its own operator already.
    """
    model = MODELS[name].fit(initial)
    firsts = [(s.operator, s.refinements[0]) for s in sequences]
    gaps = [gap(model, wanted) for _, wanted in firsts]
    left = []
    for teacher, correction in firsts:
        taught = model.updated(correction)
        for (operator, wanted), before in zip(firsts, gaps, strict=True):
            near = np.linalg.norm(wanted.condition - correction.condition) <= SAME_CONDITION
            if operator != teacher and near:
                left.append(gap(taught, wanted) / before)
    if not left:
        return None
    return Transfer(
        name, len(left), float(np.median(left)), float(np.quantile(left, 0.9)), float(np.mean(np.array(left) > 1.0))
    )
