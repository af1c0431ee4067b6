"""What a study's tests can find, of the people who were there; never of the effect that was found (Hoenig 2001)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache

import numpy as np
from scipy.special import ndtri

from services.study.analysis.comparison import Result
from services.study.analysis.hypotheses import Direction
from services.study.analysis.numerals import figure, p_value
from services.study.analysis.ranks import EXACT_UP_TO, null_signed

POWER = 0.8

_DRAWS = 5_000  # the figure is within 1 % of what more of them give
_SEED = 0


def sensitivity(family: Sequence[Result], alpha: float) -> str:
    """In words, by how many people are in the tests; empty where nobody is in any.

    Each hypothesis is taken at the strictest level that Holm's method can ask of it, that of its first step.

    Args:
        family: of confirmatory hypotheses, tested.
        alpha: its error rate.
    """
    tested = [one for one in family if one.test is not None]
    found, impossible = [], []
    for people, tails in sorted({(one.people, _tails(one)) for one in tested}):
        shift = detectable(people, alpha / len(tested) / tails)
        who = f"{people} participant{'s' * (people > 1)}{', two-sided' if tails == 2 else ''}"
        if shift is None:
            least = tails * 0.5**people
            impossible.append(
                f"nothing can be shown with {who}: the exact test's smallest p is {p_value(least)}, after Holm's first"
                f" step {p_value(min(1.0, least * len(tested)))}, which is above {alpha:g}"
            )
        else:
            found.append(f"{who}: a shift of {figure(shift, 2)} standard deviations of the differences")
    if found:
        found[0] = f"found with {100.0 * POWER:g} % power at Holm's strictest level: {found[0]}"
    return "; ".join((*found, *impossible))


@cache
def detectable(people: int, level: float) -> float | None:
    """The shift that a signed-rank test finds with `POWER`, in standard deviations of normal differences.

    None where no data of so few people can be below the level. Of an exact test by simulation: W+ is the number of
    means of two differences above zero (Tukey 1949), so that each drawn sample tells the shift from which it is found.
    Of a large one by its asymptotic efficiency of 3 / pi relative to Student's (Lehmann 2006, section 4.3).

    Args:
        people: in the test.
        level: of the test, in one tail.
    """
    if people > EXACT_UP_TO:
        return float((ndtri(1.0 - level) + ndtri(POWER)) / math.sqrt(people * 3.0 / math.pi))
    upper = np.cumsum(null_signed(people)[::-1])  # P(W+ >= w), from the largest w down
    within = int(np.count_nonzero(upper <= level * (1.0 + 1e-12)))
    if not within:
        return None
    needed = len(upper) - within  # the least W+ that is found
    d = np.random.default_rng(_SEED).standard_normal((_DRAWS, people))
    i, j = np.triu_indices(people)
    means = (d[:, i] + d[:, j]) / 2.0
    from_ = -np.partition(means, means.shape[1] - needed, axis=1)[:, means.shape[1] - needed]
    return float(np.quantile(from_, POWER))


def _tails(one: Result) -> int:
    return 2 if one.hypothesis.direction is Direction.DIFFERENT else 1
