"""Linear mixed models: what method, position in the order and model do, beside each other, to one participant's values.

A participant is a random intercept; method, position and model are fixed factors, and vary within a participant.
Estimates are by restricted maximum likelihood, see `reml`; tests and intervals have the degrees of freedom within
participants (Schluchter and Elashoff 1990): in a balanced study they are those of the analysis of variance.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import msgspec
import numpy as np
from numpy.typing import NDArray
from scipy.special import fdtrc, stdtr, stdtrit

from services.study.analysis.exclusion import Sample
from services.study.analysis.hypotheses import Measure
from services.study.analysis.observations import Observations, in_order
from services.study.analysis.reml import Estimate, reml
from services.study.analysis.units import of_models, of_people

Array = NDArray[np.float64]

Labels = Sequence[tuple[str, str, str]]
"""Of the design's columns: factor, level, and the level that it is compared with."""

LEAST_PEOPLE = 3
_OF_METHODS = ("method", "previous")
_FIRST = "none before"


class Coefficient(msgspec.Struct, frozen=True):
    """Of one level against the first of its factor.

    Attributes:
        factor: it is of; "intercept" of what is left.
        level: of the factor.
        against: the factor's first level.
        estimate: of the difference; on logarithms the logarithm of a ratio.
        error: standard error.
        low: lower end of the interval.
        high: upper end.
        p: of Student's t against none.
    """

    factor: str
    level: str
    against: str
    estimate: float
    error: float
    low: float
    high: float
    p: float

    @property
    def ratio(self) -> float:
        """What a difference of logarithms comes to."""
        return math.exp(self.estimate)

    @property
    def ratio_low(self) -> float:
        """Its lower end."""
        return math.exp(self.low)

    @property
    def ratio_high(self) -> float:
        """Its upper end."""
        return math.exp(self.high)


class Factor(msgspec.Struct, frozen=True):
    """The test of all levels of a factor together.

    Attributes:
        name: of the factor.
        statistic: Fisher's F.
        freedom: its degrees of freedom, of the factor and within participants.
        p: of no difference between any levels.
    """

    name: str
    statistic: float
    freedom: tuple[int, int]
    p: float


class MixedModel(msgspec.Struct, frozen=True):
    """A model that was fitted, or why it was not.

    Attributes:
        measure: it explains.
        sample: whom it is about.
        logarithm: it explains the measure's natural logarithm: effects are ratios.
        rows: values.
        people: participants.
        coefficients: the intercept first.
        factors: tested as a whole.
        between: variance between participants.
        within: variance that is left.
        reason: why there is none; empty where there is one.
    """

    measure: Measure
    sample: Sample
    logarithm: bool
    rows: int
    people: int
    coefficients: tuple[Coefficient, ...] = ()
    factors: tuple[Factor, ...] = ()
    between: float | None = None
    within: float | None = None
    reason: str = ""

    @property
    def correlation(self) -> float | None:
        """Between two values of one participant."""
        if self.between is None or self.within is None or not self.between + self.within:
            return None
        return self.between / (self.between + self.within)


@dataclass(frozen=True)
class Row:
    """One value and what it may depend on.

    Attributes:
        participant: code.
        value: of the measure.
        levels: by factor.
    """

    participant: str
    value: float
    levels: dict[str, str]


def fitted(
    observations: Observations, measure: Measure, sample: Sample, confidence: float, *, previous: bool = False
) -> MixedModel:
    """The mixed model of a measure.

    Args:
        observations: of the study.
        measure: times and counts are explained model by model, times by their logarithm; ratings method by method.
        sample: whom it is about.
        confidence: of the intervals.
        previous: with the method before as a further factor, for a carry-over of the first order.
    """
    rows = _rows(observations, measure, sample, previous=previous)
    logarithm = measure is Measure.SECONDS
    if logarithm:
        rows = [replace(row, value=float(np.log(row.value))) for row in rows]
    people = len({row.participant for row in rows})
    found = MixedModel(measure, sample, logarithm, len(rows), people)
    names = [name for name in ("method", "position", "model", "previous") if len({_level(r, name) for r in rows}) > 1]
    if not previous and "method" not in names:
        return msgspec.structs.replace(found, reason="there is one method only")
    return _fit(found, rows, names, observations.methods, confidence)


def _rows(observations: Observations, measure: Measure, sample: Sample, *, previous: bool) -> list[Row]:
    before, at = _order(observations)
    rows = []
    if measure.rated:
        for (participant, method), value in of_people(observations, measure, sample).items():
            levels = {"method": method, "position": at.get((participant, method), "")}
            rows.append(Row(participant, value, levels))
    else:
        for one in of_models(observations, measure, sample):
            levels = {
                "method": one.method,
                "position": at.get((one.participant, one.method), ""),
                "model": str(one.model),
            }
            rows.append(Row(one.participant, one.value, levels))
    if previous:
        for row in rows:
            row.levels["previous"] = before.get((row.participant, row.levels["method"]), "")
    # In a fixed order: the estimation's last digits are the same whatever the table's.
    return sorted(rows, key=lambda row: (row.participant, *row.levels.values()))


def _order(observations: Observations) -> tuple[dict[tuple[str, str], str], dict[tuple[str, str], str]]:
    """The method before and the position, by participant and method; nothing where an order is not known."""
    before, at = {}, {}
    for participant in observations.participants:
        order = observations.order(participant)
        for position, (method, last) in enumerate(zip(order, (_FIRST, *order), strict=False), 1):
            before[participant, method], at[participant, method] = last, str(position)
    return before, at


def _level(row: Row, name: str) -> str:
    return row.levels.get(name, "")


def _fit(
    found: MixedModel, rows: Sequence[Row], names: Sequence[str], methods: Sequence[str], confidence: float
) -> MixedModel:
    columns, labels = [np.ones(len(rows))], [("intercept", "", "")]
    for name in names:
        known = {_level(row, name) for row in rows}
        levels = [one for one in (_FIRST, *methods) if one in known] if name in _OF_METHODS else in_order(known)
        for level in levels[1:]:
            columns.append(np.array([float(_level(row, name) == level) for row in rows]))
            labels.append((name, level, levels[0]))
    design = np.column_stack(columns)
    # After the first position is always some method: one column of both factors says the same.
    kept = _independent(design)
    design, labels = design[:, kept], [labels[i] for i in kept]
    freedom = len(rows) - len(kept) - (found.people - 1)
    if found.people < LEAST_PEOPLE or freedom < 1:
        return msgspec.structs.replace(found, reason=f"{len(rows)} values of {found.people} people are too few")
    estimate = reml(np.array([row.value for row in rows]), design, [row.participant for row in rows])
    return msgspec.structs.replace(
        found,
        coefficients=_coefficients(labels, estimate, freedom, confidence),
        factors=tuple(_factor(one, labels, estimate, freedom) for one in names if any(n == one for n, *_ in labels)),
        between=estimate.between,
        within=estimate.within,
    )


def _independent(design: Array) -> list[int]:
    """The columns that are no combination of those before them."""
    kept: list[int] = []
    for i in range(design.shape[1]):
        if np.linalg.matrix_rank(design[:, [*kept, i]]) > len(kept):
            kept.append(i)
    return kept


def _coefficients(labels: Labels, estimate: Estimate, freedom: int, confidence: float) -> tuple[Coefficient, ...]:
    b, errors = estimate.coefficients, np.sqrt(np.diag(estimate.covariance))
    half = float(stdtrit(freedom, (1.0 + confidence) / 2.0)) * errors
    p = 2.0 * stdtr(freedom, -np.abs(b) / errors)
    figures = np.column_stack((b, errors, b - half, b + half, p)).tolist()
    return tuple(Coefficient(*label, *row) for label, row in zip(labels, figures, strict=True))


def _factor(name: str, labels: Labels, estimate: Estimate, freedom: int) -> Factor:
    of = [i for i, (factor, *_) in enumerate(labels) if factor == name]
    b = estimate.coefficients[of]
    f = float(b @ np.linalg.solve(estimate.covariance[np.ix_(of, of)], b)) / len(of)
    return Factor(name, f, (len(of), freedom), float(fdtrc(len(of), freedom, f)))
