"""How well a model predicts a condition that it has not seen."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial.distance import cdist

from lfd.motion.alignment import group_by_condition
from tests.bench.baselines.models import MODELS

SAME_CONDITION = 0.02  # [m] the marker's noise is a few millimetres, and people put an object back to within some more
NINETY_PER_CENT = 1.6448536  # of a Gaussian, in standard deviations


@dataclass(frozen=True)
class LeftOut:
    """One model on one set, means over the demonstrations left out: errors [m] and coverage [-]."""

    model: str
    name: str
    conditions: int
    demonstrations: int
    time: float
    path: float
    end: float
    coverage: float


def leave_out(name, set_name, demonstrations):
    """None where there is but one condition."""
    groups = group_by_condition(np.array([d.condition for d in demonstrations]), SAME_CONDITION)
    rows = []
    for group in groups:
        rest = [d for i, d in enumerate(demonstrations) if i not in group]
        if rest:
            model = MODELS[name].fit(rest)
            rows += [errors(model, demonstrations[i]) for i in group]
    if not rows:
        return None
    return LeftOut(name, set_name, len(groups), len(demonstrations), *np.mean(rows, axis=0).tolist())


def errors(model, wanted):
    """Time, path and end error [m], and the coverage [-], of a model's prediction of a motion."""
    truth = wanted.trajectory.positions
    prediction = model.predict(wanted.situation, len(truth))
    predicted = prediction.trajectory.positions
    error = truth - predicted
    distances = cdist(truth, predicted)
    nearest = np.concatenate([distances.min(axis=0), distances.min(axis=1)])
    deviations = np.sqrt(np.diagonal(prediction.position_covariances, axis1=1, axis2=2))
    # The first point is where the robot stands: nothing is predicted there.
    inside = np.abs(error[1:]) <= NINETY_PER_CENT * deviations[1:]
    return [
        np.sqrt(np.mean(np.sum(error**2, axis=1))),
        np.sqrt(np.mean(nearest**2)),
        np.linalg.norm(error[-1]),
        np.mean(inside),
    ]
