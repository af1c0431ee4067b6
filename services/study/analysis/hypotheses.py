"""What a study asks, as data: fixed before anybody has seen a figure."""

from __future__ import annotations

from enum import Enum
from typing import Annotated

import msgspec

from services.study.analysis.exceptions import AnalysisError, UnknownMethod
from services.study.analysis.observations import Observations

Share = Annotated[float, msgspec.Meta(gt=0.0, lt=1.0)]


class Measure(Enum):
    """What is compared."""

    SECONDS = "seconds"
    WORKLOAD = "workload"
    RAW_TLX = "raw_tlx"
    SUS = "sus"
    TRUST = "trust"
    REFINEMENTS = "refinements"
    UPDATES = "updates"

    @property
    def title(self) -> str:
        """As an axis or a heading has it."""
        return _TITLES[self][0]

    @property
    def unit(self) -> str:
        """Empty where it has none."""
        return _TITLES[self][1]

    @property
    def rated(self) -> bool:
        """A participant says it of a method, once; else it is measured of every model."""
        return self in _RATED


_TITLES = {
    Measure.SECONDS: ("refinement time", "s"),
    Measure.WORKLOAD: ("workload (NASA-TLX, weighted)", ""),
    Measure.RAW_TLX: ("workload (NASA-TLX, raw)", ""),
    Measure.SUS: ("usability (SUS)", ""),
    Measure.TRUST: ("trust", ""),
    Measure.REFINEMENTS: ("refinements a model", ""),
    Measure.UPDATES: ("updates a model", ""),
}

_RATED = frozenset((Measure.WORKLOAD, Measure.RAW_TLX, Measure.SUS, Measure.TRUST))


class Direction(Enum):
    """Of the first methods against the second, in the alternative hypothesis."""

    LESS = "less"
    GREATER = "greater"
    DIFFERENT = "different"

    @property
    def sign(self) -> str:
        """Between the two sides."""
        return {Direction.LESS: "<", Direction.GREATER: ">", Direction.DIFFERENT: "≠"}[self]


class Hypothesis(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A contrast of two sets of methods in one measure.

    Attributes:
        name: short, such as "online is faster".
        measure: what is compared.
        first: methods of the one side.
        second: of the other; the n-th of them differs from the n-th of the first only in what the hypothesis is about.
        direction: of the first against the second.
        labels: of both sides, such as ("online", "offline"); their methods by default.
        confirmatory: it is in the family whose error rate is controlled.
        smallest: effect of interest, as a shift in the measure's unit; drawn beside the interval.
    """

    name: str
    measure: Measure
    first: Annotated[tuple[str, ...], msgspec.Meta(min_length=1)]
    second: Annotated[tuple[str, ...], msgspec.Meta(min_length=1)]
    direction: Direction = Direction.LESS
    labels: tuple[str, str] | None = None
    confirmatory: bool = True
    smallest: float | None = None

    @property
    def sides(self) -> tuple[str, str]:
        """What both are called."""
        return self.labels or (" + ".join(self.first), " + ".join(self.second))

    def check(self, observations: Observations) -> None:
        """Let pass what is about methods that were used.

        Raises:
            UnknownMethod: one was not.
        """
        for method in (*self.first, *self.second):
            if method not in observations.methods:
                raise UnknownMethod(self.name, method, observations.methods)


_ONLINE, _OFFLINE = ("OnStyl", "OnKey"), ("OffStyl", "OffKey")
_STYLUS, _KEYBOARD = ("OnStyl", "OffStyl"), ("OnKey", "OffKey")
_LEARNING, _DEVICE = ("online", "offline"), ("stylus", "keyboard")

THESIS_METHODS = ("OnStyl", "OnKey", "OffStyl", "OffKey")

THESIS_HYPOTHESES = (
    Hypothesis("stylus is faster", Measure.SECONDS, _STYLUS, _KEYBOARD, labels=_DEVICE),
    Hypothesis("online is faster", Measure.SECONDS, _ONLINE, _OFFLINE, labels=_LEARNING),
    Hypothesis("stylus is less work", Measure.WORKLOAD, _STYLUS, _KEYBOARD, labels=_DEVICE),
    Hypothesis("online is less work", Measure.WORKLOAD, _ONLINE, _OFFLINE, labels=_LEARNING),
)
"""H1 to H4 of the thesis, Section III."""


class Plan(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How a study is to be analysed; part of what is frozen before it begins.

    Attributes:
        rules: by name, see `services.study.analysis.rules`.
        hypotheses: in the order of the report.
        methods: in its order; the models compare all others with the first.
        alpha: error rate of the family of confirmatory hypotheses; the rules' by default.
        confidence: of every interval.
        seed: of resampling.
    """

    rules: str = "retouch"
    hypotheses: tuple[Hypothesis, ...] = THESIS_HYPOTHESES
    methods: tuple[str, ...] = THESIS_METHODS
    alpha: Share | None = None
    confidence: Share = 0.95
    seed: int = 0

    def check(self, observations: Observations) -> None:
        """Let pass hypotheses of names of their own about methods that were used.

        Raises:
            UnknownMethod: one was not.
            AnalysisError: two have one name.
        """
        names = [one.name for one in self.hypotheses]
        for one in self.hypotheses:
            if names.count(one.name) > 1:
                raise AnalysisError(f"two hypotheses are called {one.name!r}: give each a name of its own")
            one.check(observations)
