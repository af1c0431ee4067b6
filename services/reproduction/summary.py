"""What the runs of one analysis come to, of one person or of many."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from statistics import fmean, stdev

from scipy.special import stdtrit

from services.offline.proportion import Proportion
from services.reproduction.analysis import Analysis, Claim, Figure, Finding, Row, Source, Value

_CONFIDENCE = 0.95
_HALF = 0.5
VARIES = "varies"


class Holds(Enum):
    """Whether a claim does."""

    YES = "holds"
    NO = "does not hold"
    UNDECIDED = "undecided"

    def of(self, count: int) -> str:
        """So many claims, as in "1 holds" and "2 do not hold"."""
        said = self.value if count == 1 else {Holds.YES: "hold", Holds.NO: "do not hold"}.get(self, self.value)
        return f"{count} {said}"


@dataclass(frozen=True)
class Estimate:
    """A mean over people, with its 95 % interval.

    Attributes:
        mean: of all of them.
        low: lower end of the interval of the mean, by Student's t.
        high: its upper end.
        people: how many.
    """

    mean: float
    low: float
    high: float
    people: int

    @classmethod
    def of(cls, values: Sequence[float], total: float | None = None) -> Estimate:
        """Of one value a person; the interval ends where no value can lie.

        Args:
            values: at least one.
            total: that no value exceeds.
        """
        mean, n = fmean(values), len(values)
        if n == 1 or not all(map(math.isfinite, values)):
            return cls(mean, mean, mean, n)
        half = float(stdtrit(n - 1, 0.5 + 0.5 * _CONFIDENCE)) * stdev(values) / math.sqrt(n)
        least = 0.0 if min(values) >= 0.0 else -math.inf
        return cls(mean, max(mean - half, least), min(mean + half, math.inf if total is None else total), n)


Cell = Estimate | Proportion | str
"""What a column says of a quantity: a mean over people, how many of them, or a text."""


@dataclass(frozen=True)
class SummaryRow:
    """A `Row` of all runs.

    Attributes:
        row: of the first run.
        cells: by name of the model.
    """

    row: Row
    cells: dict[str, Cell]


@dataclass(frozen=True)
class Judgement:
    """A `Claim` in all runs.

    Attributes:
        claim: of the first run.
        value: of the figure.
        bound: of what it is held against.
        held: in how many of the runs.
        holds: as a whole: of what is the same for everybody, that it does; of people, that it does for more than half
            of all there could be, undecided where the interval does not tell.
    """

    claim: Claim
    value: Estimate
    bound: Estimate
    held: Proportion
    holds: Holds


@dataclass(frozen=True)
class Summary:
    """What an analysis found.

    Attributes:
        judgements: of its claims.
        rows: of its table.
        figures: of the first run.
        notes: of the first run.
        people: in all; none where none takes part.
        seconds: of work, on one processor [s].
    """

    judgements: tuple[Judgement, ...]
    rows: tuple[SummaryRow, ...]
    figures: tuple[Figure, ...]
    notes: tuple[str, ...]
    people: int
    seconds: float

    def count(self, holds: Holds, source: Source | None = None) -> int:
        """Claims of which that was found, of anybody or of one source."""
        return sum(one.holds is holds and source in (None, one.claim.source) for one in self.judgements)


def summarised(analysis: Analysis, findings: Sequence[Finding], seconds: float) -> Summary:
    """The runs of an analysis as one.

    Args:
        analysis: whose runs they are.
        findings: at least one, the illustrated one first.
        seconds: that all of them took.
    """
    claims = zip(*(finding.claims for finding in findings), strict=True)
    rows = zip(*(finding.rows for finding in findings), strict=True)
    first = findings[0]
    return Summary(
        tuple(judged(runs, person=analysis.person) for runs in claims),
        tuple(_row(runs) for runs in rows),
        first.figures,
        first.notes,
        len(findings) if analysis.person else 0,
        seconds,
    )


def judged(runs: Sequence[Claim], *, person: bool) -> Judgement:
    """A claim by its runs.

    Args:
        runs: at least one.
        person: every run is another person's.
    """
    held = Proportion(sum(claim.holds for claim in runs), len(runs))
    value, bound = (Estimate.of(figures) for figures in zip(*((c.value, c.bound) for c in runs), strict=True))
    return Judgement(runs[0], value, bound, held, _of_people(held) if person else _of_all(held))


def _of_people(held: Proportion) -> Holds:
    low, high = held.interval
    if low > _HALF:
        return Holds.YES
    return Holds.NO if high < _HALF else Holds.UNDECIDED


def _of_all(held: Proportion) -> Holds:
    return Holds.YES if held.successes == held.trials else Holds.NO


def _row(runs: Sequence[Row]) -> SummaryRow:
    first = runs[0]
    return SummaryRow(first, {name: _cell([run.values[name] for run in runs], first.total) for name in first.values})


def _cell(values: Sequence[Value], total: float | None) -> Cell:
    if all(isinstance(value, bool) for value in values):
        return Proportion(sum(value is True for value in values), len(values))
    if all(isinstance(value, int | float) for value in values):
        return Estimate.of([float(value) for value in values], total)
    return str(values[0]) if len(set(values)) == 1 else VARIES
