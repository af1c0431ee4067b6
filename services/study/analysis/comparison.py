"""The hypotheses, tested."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from statistics import median

import msgspec

from services.study.analysis.effects import Effect, rank_biserial, shift_within
from services.study.analysis.exceptions import AnalysisError
from services.study.analysis.exclusion import Sample
from services.study.analysis.hypotheses import Hypothesis, Measure, Plan
from services.study.analysis.observations import Observations
from services.study.analysis.ranks import RankTest, holm, signed_rank
from services.study.analysis.rules import Rules, Unit, rules_of
from services.study.analysis.units import Values, differences, of_models, of_people, sides


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
        AnalysisError: two hypotheses have one name, there are no such rules, or they cannot test a hypothesis.
    """
    rules = rules_of(plan.rules)
    plan.check(observations)
    found: list[Result] = []
    for sample in Sample:
        pairing = _Pairing(observations, sample, rules)
        tested = [_tested(pairing, one, plan) for one in plan.hypotheses if sample in samples_of(one.measure)]
        asked = {one.hypothesis.name for one in tested}
        # Of what the sample has nothing to say the family has what the rules have found.
        others = [one for one in found if one.sample is Sample.PLANNED and one.hypothesis.name not in asked]
        found += _adjusted(tested, others, rules, plan.alpha or rules.alpha)
    return tuple(found)


def confirmatory(observations: Observations, plan: Plan) -> dict[str, float | None]:
    """The p-values that decide, by the names of the confirmatory hypotheses: adjusted, of the planned sample.

    It does no more than that, for who asks it of thousands of simulated studies. None where nobody can be compared.
    """
    rules = rules_of(plan.rules)
    family = [one for one in plan.hypotheses if one.confirmatory]
    pairing = _Pairing(observations, Sample.PLANNED, rules)
    tests = {one.name: _test(pairing.pairs(one)[0], one, rules) for one in family}
    known = {name: test.p for name, test in tests.items() if test is not None}
    adjusted = holm(list(known.values())) if rules.holm else list(known.values())
    return dict.fromkeys(tests) | dict(zip(known, adjusted, strict=True))


def samples_of(measure: Measure) -> tuple[Sample, ...]:
    """The samples that a measure has: of what is rated nobody is excluded, and only a time can outlast a limit."""
    if measure.rated:
        return (Sample.PLANNED, Sample.SUCCEEDED)
    last = (Sample.RANKED_LAST,) if measure is Measure.SECONDS else ()
    return (Sample.PLANNED, Sample.ALL, *last)


@dataclass
class _Pairing:
    """The values of one sample, each measure's taken once.

    Attributes:
        observations: of the study.
        sample: whom it is about.
        rules: by which they are paired.
    """

    observations: Observations
    sample: Sample
    rules: Rules
    _of_people: dict[Measure, Values] = field(default_factory=dict)

    @cached_property
    def people(self) -> list[str]:
        """All participants."""
        return self.observations.participants

    def pairs(self, hypothesis: Hypothesis) -> tuple[Pairs, int]:
        """The values that are compared, and of how many people.

        Raises:
            AnalysisError: the rules cannot pair the hypothesis' methods.
        """
        if self.rules.unit is Unit.MODEL:
            return self._of_models(hypothesis)
        measure = hypothesis.measure
        if measure not in self._of_people:
            self._of_people[measure] = of_people(self.observations, measure, self.sample)
        pairs = sides(self._of_people[measure], self.people, hypothesis.first, hypothesis.second)
        return pairs, len(pairs)

    def _of_models(self, hypothesis: Hypothesis) -> tuple[Pairs, int]:
        if len(hypothesis.first) != len(hypothesis.second):
            raise AnalysisError(
                f"hypothesis {hypothesis.name!r}: rules {self.rules.name!r} pair the methods of both sides one by one,"
                f" and there are {len(hypothesis.first)} and {len(hypothesis.second)}: name as many, or use rules"
                " 'retouch'"
            )
        values = of_models(self.observations, hypothesis.measure, self.sample)
        by = {(one.participant, one.model, one.method): one.value for one in values}
        keys = [(one, model) for one in self.people for model in self.observations.models]
        pairs, whose = [], set()
        for first, second in zip(hypothesis.first, hypothesis.second, strict=True):
            for participant, model in keys:
                a, b = by.get((participant, model, first)), by.get((participant, model, second))
                if a is not None and b is not None:
                    pairs.append((a, b))
                    whose.add(participant)
        return pairs, len(whose)


def _tested(pairing: _Pairing, hypothesis: Hypothesis, plan: Plan) -> Result:
    rules, sample = pairing.rules, pairing.sample
    pairs, people = pairing.pairs(hypothesis)
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


def _adjusted(results: Sequence[Result], others: Sequence[Result], rules: Rules, alpha: float) -> list[Result]:
    """The same results, adjusted in the family that they and the others make."""

    def family(of: Sequence[Result]) -> list[tuple[Result, float]]:
        return [(one, one.test.p) for one in of if one.hypothesis.confirmatory and one.test is not None]

    mine = family(results)
    p = [value for _, value in [*mine, *family(others)]]
    decided = dict(zip((one.hypothesis.name for one, _ in mine), holm(p) if rules.holm else p, strict=False))
    return [
        msgspec.structs.replace(
            one,
            adjusted=decided[one.hypothesis.name] if rules.holm else None,
            rejected=decided[one.hypothesis.name] <= alpha,
        )
        if one.hypothesis.name in decided
        else one
        for one in results
    ]
