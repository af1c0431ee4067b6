"""Which dimensions of a condition matter: judged by what is predicted for conditions that are left out."""

from dataclasses import dataclass, replace

import numpy as np

from lfd.bounds import FRACTION, at_least, check_options
from lfd.models.adaptive.regression import Regression


@dataclass(frozen=True)
class RelevanceOptions:
    """When and how dimensions are judged.

    Attributes:
        conditions: How many different ones it takes to judge a dimension that is no length.
        conditions_of_lengths: How many it takes for one that is: those are comparable by nature.
        gain: By which fraction the error at left-out conditions must fall for a change to be made.
        most: Demonstrations that are looked at; of more, that many, evenly taken.

    Raises:
        OutOfRange: One is not what it can be.
    """

    conditions: int = 8
    conditions_of_lengths: int = 15
    gain: float = 0.05
    most: int = 30

    def __post_init__(self) -> None:
        check_options(self, conditions=at_least(3), conditions_of_lengths=at_least(3), gain=FRACTION, most=at_least(3))


def relevant(regression: Regression, options: RelevanceOptions) -> Regression:
    """The regression with dimensions that do not matter switched off, and lengths of its process that fit.

    A coordinate search over a few factors for each dimension (automatic relevance determination), and over the length
    and noise of the Gaussian process: deterministic, and independent of all units.
    """
    if len(regression.groups) < min(options.conditions, options.conditions_of_lengths):
        return regression
    chosen = _thinned(regression, options.most)
    groups, first = len(chosen.groups), chosen
    enough = np.where(regression.scale.lengths, options.conditions_of_lengths, options.conditions)
    judged = np.flatnonzero((groups >= enough) & np.isfinite(regression.scale.unit)).tolist()
    for _ in range(_ROUNDS):
        before = chosen
        for d in judged:
            others = [factor for factor in _FACTORS if factor != chosen.scale.relevance[d]]
            chosen = _best(chosen, [_weighing(chosen, d, factor) for factor in others], options.gain)
        chosen = _best(chosen, [_smoothed(chosen, near, noise) for near, noise in _PROCESSES], options.gain)
        if chosen is before:
            break
    return regression if chosen is first else replace(regression, scale=chosen.scale, options=chosen.options)


def _thinned(regression: Regression, most: int) -> Regression:
    M = len(regression.conditions)
    if most >= M:
        return regression
    kept = np.linspace(0, M - 1, most).round().astype(int)
    return replace(regression, conditions=regression.conditions[kept], vectors=regression.vectors[kept])


def _best(regression: Regression, others: list[Regression], gain: float) -> Regression:
    # What predicts exactly cannot be bettered, and among such rounding is not to choose.
    if regression.score <= _EXACT:
        return regression
    best = min(others, key=lambda other: max(other.score, _EXACT))
    return best if best.score < (1.0 - gain) * regression.score else regression


def _weighing(regression: Regression, d: int, factor: float) -> Regression:
    relevance = regression.scale.relevance.copy()
    relevance[d] = factor
    return replace(regression, scale=replace(regression.scale, relevance=relevance))


def _smoothed(regression: Regression, near_spread: float, noise: float) -> Regression:
    return replace(regression, options=replace(regression.options, near_spread=near_spread, noise=noise))


_FACTORS = (0.0, 0.5, 1.0, 2.0)
_PROCESSES = ((0.2, 0.3), (0.5, 0.3), (0.5, 0.03), (1.0, 0.03), (1.0, 0.003))
_ROUNDS = 3
_EXACT = 1e-8  # as a score
