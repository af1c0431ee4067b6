"""Who is left out of what, by rules that were fixed before, and what became of everybody."""

from __future__ import annotations

from enum import Enum

import msgspec

from services.study.analysis.hypotheses import Measure
from services.study.analysis.observations import Observations


class Sample(Enum):
    """Whom a result is about."""

    PLANNED = "by the rules"
    ALL = "without exclusions"
    RANKED_LAST = "failures ranked last"
    SUCCEEDED = "who adapted everything"

    def meaning(self, measure: Measure) -> str:
        """In a clause, of a measure."""
        return _EVERYBODY if self is Sample.PLANNED and measure.rated else _MEANINGS[self]


_EVERYBODY = "everybody who rated each method of the comparison"
_MEANINGS = {
    Sample.PLANNED: (
        "without who failed to adapt a model or a training in any method, and without what was declared invalid"
    ),
    Sample.ALL: "everybody who has a value in each method of the comparison, what was declared invalid as well",
    Sample.RANKED_LAST: (
        "everybody; a model that was not adapted has a time longer than any that was measured (Lachin 1999)"
    ),
    Sample.SUCCEEDED: "only who adapted every model and passed every training: the people of the refinement time",
}


class Cell(msgspec.Struct, frozen=True):
    """What became of one method's models.

    Attributes:
        method: name.
        models: that anybody was to adapt by it.
        adapted: of them, validly.
        failed: attempted validly and not adapted.
        untouched: not adapted without a single refinement: training not passed, or nobody came so far.
        invalid: declared so.
        trained: participants who passed the training; None where that is not known.
        untrained: participants who did not.
    """

    method: str
    models: int
    adapted: int
    failed: int
    untouched: int
    invalid: int
    trained: int | None
    untrained: int | None


class Flow(msgspec.Struct, frozen=True):
    """What became of the participants.

    Attributes:
        participants: all.
        excluded: reasons by code, of those who are left out of the measures of adapting.
        rated: who rated every method.
        cells: a method each.
    """

    participants: int
    excluded: dict[str, str]
    rated: int
    cells: tuple[Cell, ...]

    @property
    def included(self) -> int:
        """Who is in the measures of adapting."""
        return self.participants - len(self.excluded)


def exclusions(observations: Observations) -> dict[str, str]:
    """Who is left out of the measures of adapting, and why: a reason a participant."""
    untrained = {(one.participant, one.method) for one in observations.trainings if not one.passed}
    of: dict[tuple[str, str], list[int]] = {}
    adapted: set[tuple[str, str]] = set()
    for one in observations.outcomes:
        failed = of.setdefault((one.participant, one.method), [])
        if one.valid and not one.adapted:
            failed.append(one.model)
        if one.valid and one.adapted and one.seconds is not None:
            adapted.add((one.participant, one.method))
    excluded = {}
    for participant in observations.participants:
        reasons = []
        for method in observations.methods:
            pair = (participant, method)
            if pair in untrained:
                reasons.append(f"{method}: training not passed")
            elif of.get(pair):
                models = ", ".join(map(str, sorted(of[pair])))
                reasons.append(f"{method}: model{'s' * (len(of[pair]) > 1)} {models} not adapted")
            elif pair not in adapted:
                reasons.append(f"{method}: no valid time")
        if reasons:
            excluded[participant] = "; ".join(reasons)
    return excluded


def flow_of(observations: Observations) -> Flow:
    """What became of everybody."""
    rated = {(one.participant, one.method) for one in observations.ratings}
    people, methods = observations.participants, observations.methods
    complete = sum(all((person, method) in rated for method in methods) for person in people)
    return Flow(len(people), exclusions(observations), complete, tuple(_cell(observations, one) for one in methods))


def _cell(observations: Observations, method: str) -> Cell:
    outcomes = [one for one in observations.outcomes if one.method == method]
    missed = [one for one in outcomes if one.valid and not one.adapted]
    untouched = sum(not one.refinements and one.seconds is None and one.refinements is not None for one in missed)
    trainings = [one.passed for one in observations.trainings if one.method == method]
    return Cell(
        method,
        len(outcomes),
        sum(one.valid and one.adapted for one in outcomes),
        len(missed) - untouched,
        untouched,
        sum(not one.valid for one in outcomes),
        sum(trainings) if trainings else None,
        len(trainings) - sum(trainings) if trainings else None,
    )


def left_out(observations: Observations, measure: Measure, sample: Sample) -> frozenset[str]:
    """Participants who are not in a measure's sample; by the rules nobody is left out of what is rated."""
    excluding = sample is Sample.SUCCEEDED or (sample is Sample.PLANNED and not measure.rated)
    return frozenset(exclusions(observations) if excluding else ())
