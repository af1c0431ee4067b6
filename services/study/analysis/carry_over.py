"""Whether the order of the methods shows in the results: what one method leaves behind for the next.

Said beside the results and never used to choose among analyses: a test that is chosen by a test for carry-over does not
keep its error rate (Freeman 1989).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import msgspec
import numpy as np

from services.study.analysis.effects import Effect, shift_between
from services.study.analysis.exclusion import Sample
from services.study.analysis.hypotheses import Direction, Hypothesis, Measure, Plan
from services.study.analysis.mixed import MixedModel, fitted
from services.study.analysis.observations import Observations
from services.study.analysis.ranks import kruskal_wallis, mann_whitney
from services.study.analysis.units import Values, of_people, side

_LEAST = 2
"""In a group; fewer say nothing about it."""


class Check(msgspec.Struct, frozen=True):
    """One way in which an order could show.

    Attributes:
        measure: in which.
        question: what is asked.
        test: by which test, with its statistic; empty where it could not be made.
        p: that the order shows no more than chance has it; None where it could not be asked.
        people: in the test.
        shift: between the two groups, where there are two.
        reason: why it could not be asked; empty where it was.
    """

    measure: Measure
    question: str
    test: str
    p: float | None
    people: int
    shift: Effect = Effect(None)
    reason: str = ""


def carry_over(observations: Observations, plan: Plan, measures: Sequence[Measure]) -> tuple[Check, ...]:
    """All checks of measures: of the sequences, of what came first, of the method before.

    Args:
        observations: of the study.
        plan: its hypotheses, confidence and seed.
        measures: to check.
    """
    if not any(observations.order(one) for one in observations.participants):
        reason = "the positions of the methods are not known"
        return (Check(measures[0], "does the order of the methods show?", "", None, 0, reason=reason),)
    checks: list[Check] = []
    for measure in measures:
        values = of_people(observations, measure, Sample.PLANNED)
        checks.append(_sequences(observations, plan, measure, values))
        checks += [_first(observations, plan, one, values) for one in plan.hypotheses if one.measure is measure]
        model = fitted(observations, measure, Sample.PLANNED, plan.confidence, previous=True)
        checks += [_factor(model, measure, "position", "does the position in the order matter?")]
        checks += [_factor(model, measure, "previous", "does the method before matter (first-order carry-over)?")]
    return tuple(checks)


def _sequences(observations: Observations, plan: Plan, measure: Measure, values: Values) -> Check:
    """Totals of participants by sequence, after Grizzle (1965) and Hills and Armitage (1979)."""
    question = "do groups of one sequence differ over all methods together?"
    groups: dict[str, list[float]] = {}
    told = {one.participant: one.group for one in observations.backgrounds}
    for participant in observations.participants:
        total = side(values, participant, observations.methods)
        sequence = told.get(participant) or " ".join(observations.order(participant))
        if total is not None and sequence:
            groups.setdefault(sequence, []).append(total)
    kept = [group for group in groups.values() if len(group) >= _LEAST]
    people = sum(map(len, kept))
    if len(kept) < 2:
        return Check(measure, question, "", None, people, reason="fewer than two groups of two people")
    found = kruskal_wallis(kept, np.random.default_rng(plan.seed))
    test = f"Kruskal-Wallis, H({len(kept) - 1}) = {found.statistic:.2f}, 10 000 permutations"
    return Check(measure, question, test, found.p, people)


def _first(observations: Observations, plan: Plan, hypothesis: Hypothesis, values: Values) -> Check:
    """Differences of who began with the one side, against those of who began with the other: the period's part."""
    a, b = hypothesis.sides
    question = f"is {a} against {b} different where {a} came first?"
    began: tuple[list[float], list[float]] = ([], [])
    for participant in observations.participants:
        order = observations.order(participant)
        sides = side(values, participant, hypothesis.first), side(values, participant, hypothesis.second)
        if order and sides[0] is not None and sides[1] is not None:
            met = [hypothesis.first, hypothesis.second]
            for of, methods in zip(began, met, strict=True):
                if order[0] in methods:
                    of.append(sides[0] - sides[1])
    people = sum(map(len, began))
    if min(map(len, began)) < _LEAST:
        return Check(hypothesis.measure, question, "", None, people, reason="fewer than two people began with one side")
    found = mann_whitney(*began, Direction.DIFFERENT)
    test = f"Mann-Whitney, U = {found.statistic:g}{', exact' if found.exact else ''}"
    return Check(hypothesis.measure, question, test, found.p, people, shift_between(*began, plan.confidence))


def _factor(model: MixedModel, measure: Measure, name: str, question: str) -> Check:
    factor = next((one for one in model.factors if one.name == name), None)
    if factor is None or not math.isfinite(factor.statistic):
        reason = model.reason or "it cannot be told from the other factors"
        return Check(measure, question, "", None, model.people, reason=reason)
    test = f"mixed model, F({factor.freedom[0]}, {factor.freedom[1]}) = {factor.statistic:.2f}"
    return Check(measure, question, test, factor.p, model.people)
