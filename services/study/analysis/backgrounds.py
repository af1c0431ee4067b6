"""Whether who takes part shows in the results: exploratory, every p-value as it is."""

from __future__ import annotations

from collections.abc import Sequence
from statistics import median

import msgspec
import numpy as np
from scipy.stats import rankdata

from services.study.analysis.effects import Effect, cliffs_delta, shift_between
from services.study.analysis.exclusion import Sample
from services.study.analysis.hypotheses import Direction, Measure, Plan
from services.study.analysis.numerals import figure
from services.study.analysis.observations import Observations, in_order
from services.study.analysis.ranks import kruskal_wallis, mann_whitney
from services.study.analysis.units import of_people, side

ASKED = ("gender", "age", "field", "gaming", "teleoperation", "handedness")

_LEAST = 2
_NUMBERS = 3  # that are different, from which on they are a scale and no names of groups
_PERMUTATIONS = 10_000


class Group(msgspec.Struct, frozen=True):
    """Participants who said the same.

    Attributes:
        said: what.
        people: how many with a value.
        median: of their values.
    """

    said: str
    people: int
    median: float


class Influence(msgspec.Struct, frozen=True):
    """Of one thing about the participants on one measure, each participant's mean over all methods.

    Attributes:
        background: what about them.
        measure: on which.
        groups: by what they said.
        test: with its statistic; empty where there is none.
        p: two-sided, not adjusted; None where there is no test.
        effect: Spearman's rank correlation, or Cliff's delta of the first group against the second.
        shift: of the first group from the second, where there are two.
        reason: why there is no test; empty where there is one.
        scale: what they said are numbers.
    """

    background: str
    measure: Measure
    groups: tuple[Group, ...]
    test: str = ""
    p: float | None = None
    effect: Effect = Effect(None)
    shift: Effect = Effect(None)
    reason: str = ""
    scale: bool = False


def influences(observations: Observations, plan: Plan, measures: Sequence[Measure]) -> tuple[Influence, ...]:
    """Of everything that anybody said about himself, on each of the measures.

    Args:
        observations: of the study.
        plan: its confidence and seed.
        measures: to explain.
    """
    found = []
    for background in ASKED:
        said = {b.participant: str(getattr(b, background)) for b in observations.backgrounds if getattr(b, background)}
        if said:
            found += [_influence(observations, plan, background, said, measure) for measure in measures]
    return tuple(found)


def spearman(first: Sequence[float], second: Sequence[float], seed: int) -> tuple[float, float]:
    """Spearman's rank correlation and its two-sided p-value by random permutations.

    Args:
        first: values, shape (n,), not all the same.
        second: values, shape (n,), not all the same.
        seed: of the permutations.
    """
    x, y = (rankdata(one) - (len(one) + 1) / 2.0 for one in (first, second))
    scale = float(np.sqrt((x @ x) * (y @ y)))
    rho = float(x @ y) / scale
    drawn = np.random.default_rng(seed).permuted(np.tile(y, (_PERMUTATIONS, 1)), axis=1) @ x / scale
    return rho, float((1.0 + np.count_nonzero(np.abs(drawn) >= abs(rho) - 1e-9)) / (_PERMUTATIONS + 1.0))


def _influence(
    observations: Observations, plan: Plan, background: str, said: dict[str, str], measure: Measure
) -> Influence:
    values = of_people(observations, measure, Sample.PLANNED)
    totals = {one: side(values, one, observations.methods) for one in observations.participants if one in said}
    known = {one: total for one, total in totals.items() if total is not None}
    of = {text: sorted(known[one] for one in known if said[one] == text) for text in in_order(said.values())}
    groups = tuple(Group(text, len(of[text]), median(of[text])) for text in of if of[text])
    found = Influence(background, measure, groups)
    numbers = {one: number for one in known if (number := _number(said[one])) is not None}
    if len(numbers) == len(known) and len(set(numbers.values())) >= _NUMBERS and len(set(known.values())) > 1:
        # By their values, so that the permutations are the same whatever the order of the people.
        pairs = sorted((numbers[one], known[one]) for one in known)
        rho, p = spearman([a for a, _ in pairs], [b for _, b in pairs], plan.seed)
        spoken = f"Spearman's rho = {figure(rho, 2)}, n = {len(pairs)}, 10 000 permutations"
        return msgspec.structs.replace(found, test=spoken, p=p, effect=Effect(rho), scale=True)
    large = [of[text] for text in of if len(of[text]) >= _LEAST]
    if len(large) < 2 or len(large) > len(known) // _LEAST:
        return msgspec.structs.replace(found, reason="fewer than two groups of two people")
    if len(large) == 2:
        two = mann_whitney(large[0], large[1], Direction.DIFFERENT)
        return msgspec.structs.replace(
            found,
            test=f"Mann-Whitney, U = {two.statistic:g}, n = {len(large[0])} and {len(large[1])}"
            f"{', exact' if two.exact else ''}",
            p=two.p,
            effect=cliffs_delta(large[0], large[1], plan.confidence, plan.seed),
            shift=shift_between(large[0], large[1], plan.confidence),
        )
    many = kruskal_wallis(large, np.random.default_rng(plan.seed))
    test = f"Kruskal-Wallis, H({len(large) - 1}) = {many.statistic:.2f}, n = {many.n}"
    return msgspec.structs.replace(found, test=test, p=many.p)


def _number(text: str) -> float | None:
    try:
        return float(text.replace(",", "."))
    except ValueError:
        return None
