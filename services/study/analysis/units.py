"""From observations to the values that are compared: one a participant and method, or one a model."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean, median

from services.study.analysis.exclusion import Sample, left_out
from services.study.analysis.hypotheses import Measure
from services.study.analysis.observations import Observations, Outcome, Rating

Values = Mapping[tuple[str, str], float]
"""By participant and method."""


@dataclass(frozen=True)
class ModelValue:
    """A measure of one model.

    Attributes:
        participant: code.
        method: name.
        model: number.
        position: of the method, where it is known.
        value: of the measure; infinite where the model was not adapted and failures are ranked last.
    """

    participant: str
    method: str
    model: int
    position: int | None
    value: float


def of_models(observations: Observations, measure: Measure, sample: Sample) -> list[ModelValue]:
    """A measure of every model of a sample, what is rated repeated for each of the method's models."""
    out = left_out(observations, measure, sample)
    ratings = {(one.participant, one.method): one for one in observations.ratings}
    values = []
    for one in observations.outcomes:
        if one.participant in out:
            continue
        rating = ratings.get((one.participant, one.method))
        value = _rated(rating, measure) if measure.rated else _measured(one, measure, sample)
        if value is not None:
            values.append(ModelValue(one.participant, one.method, one.model, one.position, value))
    return values


def of_people(observations: Observations, measure: Measure, sample: Sample) -> Values:
    """A measure of every participant and method of a sample: the median over models, or what was rated."""
    if measure.rated:
        out = left_out(observations, measure, sample)
        ratings = [one for one in observations.ratings if one.participant not in out]
        rated = {(one.participant, one.method): _rated(one, measure) for one in ratings}
        return {pair: value for pair, value in rated.items() if value is not None}
    grouped: dict[tuple[str, str], list[float]] = {}
    for one in of_models(observations, measure, sample):
        grouped.setdefault((one.participant, one.method), []).append(one.value)
    if sample is Sample.RANKED_LAST:
        for training in observations.trainings:
            if not training.passed:  # where it ended there: there is no model to fail
                grouped.setdefault((training.participant, training.method), [math.inf])
    return {pair: median(values) for pair, values in grouped.items()}


def side(values: Values, participant: str, methods: Sequence[str]) -> float | None:
    """A participant's mean over the methods of one side; None where one of them has no value."""
    found = [values.get((participant, method)) for method in methods]
    present = [value for value in found if value is not None]
    return fmean(present) if len(present) == len(methods) else None


def sides(
    values: Values, people: Sequence[str], first: Sequence[str], second: Sequence[str]
) -> list[tuple[float, float]]:
    """Both sides of everybody who has both."""
    pairs = [(side(values, one, first), side(values, one, second)) for one in people]
    return [(a, b) for a, b in pairs if a is not None and b is not None]


def differences(pairs: Sequence[tuple[float, float]]) -> list[float]:
    """Of the first from the second; of two failures none."""
    return [0.0 if math.isinf(a) and math.isinf(b) else a - b for a, b in pairs]


def _rated(rating: Rating | None, measure: Measure) -> float | None:
    value: float | None = getattr(rating, measure.value) if rating is not None else None
    return value


def _measured(outcome: Outcome, measure: Measure, sample: Sample) -> float | None:
    if not outcome.valid and sample is not Sample.ALL:
        return None
    if not outcome.adapted:
        return math.inf if sample is Sample.RANKED_LAST else None
    value: float | None = getattr(outcome, measure.value)
    return value
