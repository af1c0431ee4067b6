"""Rules by which observations become statements, as named options: ours, and those of the thesis."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from services.study.analysis.exceptions import AnalysisError


class Unit(Enum):
    """What counts as one observation in a test."""

    PARTICIPANT = "the participant"
    MODEL = "each model of each participant"


@dataclass(frozen=True)
class Rules:
    """How hypotheses are tested.

    Attributes:
        name: as it is typed.
        unit: what counts as one observation.
        alpha: error rate, where the plan gives none.
        holm: confirmatory hypotheses are a family, adjusted by Holm's method.
        exact_up_to: so many observations the null distribution is enumerated; it is approximated beyond.
        criticism: what is wrong with these rules, a sentence each.
    """

    name: str
    unit: Unit
    alpha: float
    holm: bool
    exact_up_to: int
    criticism: tuple[str, ...] = ()


RETOUCH = Rules("retouch", Unit.PARTICIPANT, 0.05, holm=True, exact_up_to=50)

THESIS = Rules(
    "thesis",
    Unit.MODEL,
    0.01,
    holm=False,
    exact_up_to=0,
    criticism=(
        "Each model counts as an observation of its own: three models of one person are no three people, and p-values"
        " are smaller than the data bear out.",
        "A workload that a person stated once for a method is counted once for each model: every value is in the test"
        " as often as there are models, and nothing was measured more often.",
        "The two methods of each side are pooled as further pairs of the same people: a person is in each test"
        " once for each pair of methods and each model.",
        "Who failed in any method is left out of the refinement time in all of them: the comparison is among those who"
        " succeed everywhere, and how often a method fails is no part of it.",
        "Workload is tested with everybody and refinement time without those who failed: the two results are about"
        " different people.",
        "Four hypotheses are tested at 0.01 each, without an adjustment for their number.",
        "p-values come from the normal approximation, and no effect size or interval is given.",
    ),
)

_BY_NAME = {one.name: one for one in (RETOUCH, THESIS)}
NAMES = tuple(_BY_NAME)


def rules_of(name: str) -> Rules:
    """The rules of a name.

    Raises:
        AnalysisError: there are none.
    """
    if name not in _BY_NAME:
        raise AnalysisError(f"no rules are called {name!r}: one of {', '.join(NAMES)}")
    return _BY_NAME[name]
