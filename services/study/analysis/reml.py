"""Restricted maximum likelihood of a linear model with a random intercept a participant.

With one variance ratio the likelihood is a function of one number, whatever else is in the model: it is searched over
its whole range, and a participant's variance of nothing is its lower end instead of a failure.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

Array = NDArray[np.float64]

_LOG_RATIOS = (-14.0, 14.0)
_GRID = 57


@dataclass(frozen=True, eq=False)
class Estimate:
    """What was estimated.

    Attributes:
        coefficients: of the fixed factors, shape (k,).
        covariance: of these, shape (k, k).
        between: variance between participants.
        within: variance that is left.
    """

    coefficients: Array
    covariance: Array
    between: float
    within: float


def reml(values: Array, design: Array, participants: Sequence[str]) -> Estimate:
    """Estimate y = X b + u + e, u of a participant ~ N(0, between), e ~ N(0, within).

    Args:
        values: y, shape (n,).
        design: X of full rank, shape (n, k), k < n.
        participants: whose each value is.
    """
    _, of, sizes = np.unique(list(participants), return_inverse=True, return_counts=True)

    def whitened(ratio: float) -> tuple[Array, Array]:
        """Both with a covariance of within times the identity (Fuller and Battese 1973)."""
        share = 1.0 - 1.0 / np.sqrt(1.0 + ratio * sizes)
        both = np.column_stack((design, values))
        means = np.zeros((len(sizes), both.shape[1]))
        np.add.at(means, of, both)
        both = both - (share / sizes)[of, None] * means[of]
        return both[:, :-1], both[:, -1]

    def solved(ratio: float) -> tuple[Array, Array, float]:
        x, y = whitened(ratio)
        q, r = np.linalg.qr(x)
        b = np.linalg.solve(r, q.T @ y)
        return b, r, float(np.sum((y - x @ b) ** 2)) / (len(y) - len(b))

    def deviance(log_ratio: float) -> float:
        """-2 log of the restricted likelihood, but for a constant."""
        ratio = float(np.exp(log_ratio))
        b, r, within = solved(ratio)
        whole = (len(values) - len(b)) * np.log(max(within, np.finfo(float).tiny))
        return float(whole + np.log1p(ratio * sizes).sum() + 2.0 * np.log(np.abs(np.diag(r))).sum())

    grid = np.linspace(*_LOG_RATIOS, _GRID)
    best = grid[int(np.argmin([deviance(one) for one in grid]))]
    step = grid[1] - grid[0]
    found = minimize_scalar(deviance, bounds=(best - step, best + step), method="bounded", options={"xatol": 1e-10})
    ratio = float(np.exp(found.x)) if found.x > _LOG_RATIOS[0] + step else 0.0
    b, r, within = solved(ratio)
    inverse = np.linalg.solve(r, np.eye(len(b)))
    return Estimate(b, within * inverse @ inverse.T, ratio * within, within)
