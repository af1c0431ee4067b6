"""Medians and quartiles, a method each."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import numpy as np

from services.study.analysis.exclusion import Sample
from services.study.analysis.hypotheses import Measure
from services.study.analysis.observations import Observations
from services.study.analysis.rules import Rules, Unit
from services.study.analysis.units import of_models, of_people


class Quartiles(msgspec.Struct, frozen=True):
    """Of values, between which they are interpolated linearly (NumPy's default, definition 7 of Hyndman and Fan 1996).

    Attributes:
        lower: the first quartile.
        median: the second.
        upper: the third.
    """

    lower: float
    median: float
    upper: float

    @classmethod
    def of(cls, values: Sequence[float]) -> Quartiles:
        """Of at least one value; infinite ones are not interpolated to."""
        lower, middle, upper = (float(one) for one in np.percentile(values, (25, 50, 75)))
        return cls(lower, middle, upper)


class Summary(msgspec.Struct, frozen=True):
    """What one method's values come to.

    Attributes:
        method: name.
        measure: of it.
        sample: whose.
        values: in it: one a participant, or one a model where that is the unit.
        people: whose they are.
        quartiles: of them.
    """

    method: str
    measure: Measure
    sample: Sample
    values: int
    people: int
    quartiles: Quartiles


def summaries(observations: Observations, rules: Rules) -> tuple[Summary, ...]:
    """Of every measure that was taken, by the rules and without exclusions."""
    found = []
    for measure in Measure:
        for sample in (Sample.PLANNED,) if measure.rated else (Sample.PLANNED, Sample.ALL):
            values = _values(observations, measure, sample, rules)
            for method in observations.methods:
                of = [(who, value) for who, what, value in values if what == method]
                if of:
                    quartiles = Quartiles.of([value for _, value in of])
                    found.append(Summary(method, measure, sample, len(of), len({who for who, _ in of}), quartiles))
    return tuple(found)


def taken(observations: Observations) -> list[Measure]:
    """The measures that anybody has a value of."""
    return [one for one in Measure if of_people(observations, one, Sample.ALL)]


def _values(observations: Observations, measure: Measure, sample: Sample, rules: Rules) -> list[tuple[str, str, float]]:
    if rules.unit is Unit.MODEL:
        return [(one.participant, one.method, one.value) for one in of_models(observations, measure, sample)]
    return [(*pair, value) for pair, value in of_people(observations, measure, sample).items()]
