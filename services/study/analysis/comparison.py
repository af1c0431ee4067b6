"""The hypotheses, tested."""

from __future__ import annotations

import math
from collections.abc import Sequence
from statistics import median

import msgspec

from services.study.analysis.effects import Effect, rank_biserial, shift_within
from services.study.analysis.exceptions import AnalysisError
from services.study.analysis.exclusion import Sample
from services.study.analysis.hypotheses import Hypothesis, Measure, Plan
from services.study.analysis.observations import Observations
from services.study.analysis.ranks import RankTest, holm, signed_rank
from services.study.analysis.rules import Rules, Unit, rules_of
from services.study.analysis.units import differences, of_models, of_people, sides


class Result(msgspec.Struct, frozen=True):
    """What became of a hypothesis in one sample.

    Attributes:
        hypothesis: as it was stated.
        sample: whom it is about.
        people: in the test.
        pairs: of values in the test; one a participant where that is the unit.
        medians: of both sides; infinite where most failed.
        test: Wilcoxon's signed-rank test; None where there is no pair.
        adjusted: Holm's p in its family; None outside one.
        rejected: the null hypothesis is, at the plan's error rate; None for what is not confirmatory.
        effect: matched-pairs rank-biserial correlation; negative where the first side has less.
        shift: Hodges and Lehmann's, of the first side from the second, in the measure's unit.
    """

    hypothesis: Hypothesis
    sample: Sample
    people: int
    pairs: int
    medians: tuple[float, float] | None
    test: RankTest | None
    adjusted: float | None = None
    rejected: bool | None = None
    effect: Effect = Effect(None)
    shift: Effect = Effect(None)


Pairs = list[tuple[float, float]]


def compared(observations: Observations, plan: Plan) -> tuple[Result, ...]:
    """Every hypothesis in every sample it has, the family adjusted in each.

    Args:
        observations: of the study.
        plan: with the hypotheses.

    Raises:
        UnknownMethod: a hypothesis is about a method that nobody used.
        AnalysisError: there are no such rules, or they cannot test a hypothesis.
    """
    rules = rules_of(plan.rules)
    found = []
    for sample in Sample:
        asked = [one for one in plan.hypotheses if sample in samples_of(one.measure)]
        tested = [_tested(observations, one, sample, plan, rules) for one in asked]
        found += _adjusted(tested, rules, plan.alpha or rules.alpha)
    return tuple(found)


def confirmatory(observations: Observations, plan: Plan) -> dict[str, float | None]:
    """The p-values that decide, by the names of the confirmatory hypotheses: adjusted, of the planned sample.

    It does no more than that, for who asks it of thousands of simulated studies. None where nobody can be compared.
    """
    rules = rules_of(plan.rules)
    family = [one for one in plan.hypotheses if one.confirmatory]
    tests = {one.name: _test(_pairs(observations, one, Sample.PLANNED, rules)[0], one, rules) for one in family}
    known = {name: test.p for name, test in tests.items() if test is not None}
    adjusted = holm(list(known.values())) if rules.holm else list(known.values())
    return dict.fromkeys(tests) | dict(zip(known, adjusted, strict=True))


def samples_of(measure: Measure) -> tuple[Sample, ...]:
    """The samples that a measure has: of what is rated nobody is excluded, and only a time can outlast a limit."""
    if measure.rated:
        return (Sample.PLANNED, Sample.SUCCEEDED)
    last = (Sample.RANKED_LAST,) if measure is Measure.SECONDS else ()
    return (Sample.PLANNED, Sample.ALL, *last)


def _tested(observations: Observations, hypothesis: Hypothesis, sample: Sample, plan: Plan, rules: Rules) -> Result:
    hypothesis.check(observations)
    pairs, people = _pairs(observations, hypothesis, sample, rules)
    test = _test(pairs, hypothesis, rules)
    if test is None:
        return Result(hypothesis, sample, people, 0, None, None)
    apart = differences(pairs)
    medians = (median(a for a, _ in pairs), median(b for _, b in pairs))
    result = Result(hypothesis, sample, people, len(pairs), medians, test)
    if rules.unit is not Unit.PARTICIPANT:  # an interval over repeated values would be too narrow
        return result
    effect = rank_biserial(apart, plan.confidence, plan.seed)
    shift = shift_within(apart, plan.confidence) if all(map(math.isfinite, apart)) else Effect(None)
    return msgspec.structs.replace(result, effect=effect, shift=shift)


def _test(pairs: Pairs, hypothesis: Hypothesis, rules: Rules) -> RankTest | None:
    return signed_rank(differences(pairs), hypothesis.direction, rules.exact_up_to) if pairs else None


def _pairs(observations: Observations, hypothesis: Hypothesis, sample: Sample, rules: Rules) -> tuple[Pairs, int]:
    """The values that are compared, and of how many people."""
    people = observations.participants
    if rules.unit is Unit.PARTICIPANT:
        values = of_people(observations, hypothesis.measure, sample)
        pairs = sides(values, people, hypothesis.first, hypothesis.second)
        return pairs, len(pairs)
    by = {(v.participant, v.model, v.method): v.value for v in of_models(observations, hypothesis.measure, sample)}
    if len(hypothesis.first) != len(hypothesis.second):
        raise AnalysisError(
            f"hypothesis {hypothesis.name!r}: rules {rules.name!r} pair the methods of both sides one by one, and there"
            f" are {len(hypothesis.first)} and {len(hypothesis.second)}: name as many, or use rules 'retouch'"
        )
    keys = [(one, model) for one in people for model in observations.models]
    pairs, whose = [], set()
    for first, second in zip(hypothesis.first, hypothesis.second, strict=True):
        for participant, model in keys:
            a, b = by.get((participant, model, first)), by.get((participant, model, second))
            if a is not None and b is not None:
                pairs.append((a, b))
                whose.add(participant)
    return pairs, len(whose)


def _adjusted(results: Sequence[Result], rules: Rules, alpha: float) -> list[Result]:
    """The same results with their family's adjustment."""
    family = [i for i, one in enumerate(results) if one.hypothesis.confirmatory and one.test is not None]
    p = [test.p for i in family if (test := results[i].test) is not None]
    decided = holm(p) if rules.holm else p
    adjusted = list(results)
    for i, value in zip(family, decided, strict=True):
        adjusted[i] = msgspec.structs.replace(
            results[i], adjusted=value if rules.holm else None, rejected=value <= alpha
        )
    return adjusted
