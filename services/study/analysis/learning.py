"""Whether people became better while they took part: from model to model, and from attempt to attempt."""

from __future__ import annotations

from collections.abc import Sequence
from statistics import median

import msgspec
import numpy as np
from scipy.stats import page_trend_test

from services.offline.proportion import Proportion
from services.study.analysis.exclusion import Sample
from services.study.analysis.hypotheses import Measure
from services.study.analysis.observations import Observations
from services.study.analysis.units import ModelValue, of_models

_RELATIVE = "position"
_LEAST = 3  # models, of people as well: what Page's test needs


class Course(msgspec.Struct, frozen=True):
    """Times in sequence.

    Attributes:
        over: what is in sequence: "model" or "position".
        relative: times are shares of their method's median: at each position people have different methods.
        medians: over participants, of their median over all methods, by number.
        people: who have a value at every number.
        statistic: Page's L, for a time that falls.
        p: of the trend; None where too few have a value everywhere.
        exact: p is enumerated, not approximated.
    """

    over: str
    relative: bool
    medians: dict[int, float]
    people: int
    statistic: float | None = None
    p: float | None = None
    exact: bool = False


class Attempts(msgspec.Struct, frozen=True):
    """How the n-th attempts of a method ended.

    Attributes:
        method: name.
        number: n.
        successes: as many.
        attempts: in all; fewer with every number, for who has succeeded goes on to the next model.
    """

    method: str
    number: int
    successes: int
    attempts: int

    @property
    def proportion(self) -> Proportion:
        """Of the successes."""
        return Proportion(self.successes, self.attempts)


def courses(observations: Observations) -> tuple[Course, ...]:
    """Times from model to model, and from method to method where their positions are known."""
    values = of_models(observations, Measure.SECONDS, Sample.PLANNED)
    found = [_course("model", values)]
    if values and all(one.position is not None for one in values):
        found.append(_course("position", values))
    return tuple(one for one in found if len(one.medians) > 1)


def in_sequence(values: Sequence[ModelValue], over: str) -> dict[tuple[str, int], float]:
    """A participant's median at every number.

    Args:
        values: times.
        over: what is in sequence, see `Course`.
    """
    of_method: dict[str, list[float]] = {}
    for one in values:
        of_method.setdefault(one.method, []).append(one.value)
    usual = {method: median(times) if over == _RELATIVE else 1.0 for method, times in of_method.items()}
    grouped: dict[tuple[str, int], list[float]] = {}
    for one in values:
        grouped.setdefault((one.participant, getattr(one, over)), []).append(one.value / usual[one.method])
    return {key: median(times) for key, times in grouped.items()}


def _course(over: str, values: Sequence[ModelValue]) -> Course:
    medians = in_sequence(values, over)
    columns = sorted({number for _, number in medians})
    people = [p for p in sorted({p for p, _ in medians}) if all((p, n) in medians for n in columns)]
    shown = {n: median(value for (_, number), value in medians.items() if number == n) for n in columns}
    if len(people) < _LEAST or len(columns) < _LEAST:
        return Course(over, over == _RELATIVE, shown, len(people))
    table = np.array([[medians[p, n] for n in columns] for p in people])
    falling = page_trend_test(table, predicted_ranks=list(range(len(columns), 0, -1)))
    exact = falling.method == "exact"
    return Course(over, over == _RELATIVE, shown, len(people), float(falling.statistic), float(falling.pvalue), exact)


def attempts(observations: Observations) -> tuple[Attempts, ...]:
    """How attempts ended, by method and number."""
    ended: dict[tuple[str, int], list[bool]] = {}
    for one in observations.trials:
        ended.setdefault((one.method, one.number), []).append(one.success)
    return tuple(
        Attempts(method, number, sum(ended[method, number]), len(ended[method, number]))
        for method in observations.methods
        for number in sorted({n for m, n in ended if m == method})
    )
