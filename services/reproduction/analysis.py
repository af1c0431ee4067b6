"""What an analysis of the thesis is, and what one run of it finds."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import TypeVar

import msgspec
import numpy as np

Item = TypeVar("Item")

Value = bool | float | str
"""A yes or no, a measured number, or a text where a number does not say it."""


class Source(Enum):
    """Whose claim it is."""

    THESIS = "the thesis"
    RETOUCH = "Retouch"


class Relation(Enum):
    """Of a figure to its bound, where a claim holds."""

    BELOW = "<"
    AT_MOST = "≤"
    AT_LEAST = "≥"
    ABOVE = ">"

    def holds(self, value: float, bound: float) -> bool:
        """Whether the value stands in this relation to the bound; a value that is no number stands in none."""
        match self:
            case Relation.BELOW:
                return value < bound
            case Relation.AT_MOST:
                return value <= bound
            case Relation.AT_LEAST:
                return value >= bound
            case Relation.ABOVE:
                return value > bound


class Claim(msgspec.Struct, frozen=True):
    """A statement as a condition on a figure, which the figure can contradict.

    Attributes:
        source: whose it is.
        sentence: what is claimed, complete.
        quantity: what the figure is.
        value: the figure.
        relation: that it has to have to the bound.
        bound: a number that was fixed beforehand, or another figure.
        against: what the bound is, where it is another figure.
        unit: of both; empty where they have none.
    """

    source: Source
    sentence: str
    quantity: str
    value: float
    relation: Relation
    bound: float
    against: str = ""
    unit: str = ""

    @property
    def holds(self) -> bool:
        """Whether the figure is as it is claimed to be."""
        return self.relation.holds(self.value, self.bound)


class Row(msgspec.Struct, frozen=True):
    """One quantity, as the thesis reports it and as each model has it here.

    Attributes:
        quantity: what was measured, and where.
        values: by name of the model, see `services.reproduction.models`; of those to whom the question arises.
        unit: of the numbers; empty where they have none.
        thesis: what the thesis reports, where it does.
        total: of how many, where things are counted.
        headline: it is in the overview of all analyses, too.
    """

    quantity: str
    values: Mapping[str, Value]
    unit: str = ""
    thesis: Value | None = None
    total: float | None = None
    headline: bool = False


class Figure(msgspec.Struct, frozen=True):
    """A picture of the report, see `services.reproduction.style.drawn`.

    Attributes:
        name: unique in its analysis, short, of letters and hyphens.
        caption: what there is to see, in a sentence or two.
        image: an SVG or a PNG file.
    """

    name: str
    caption: str
    image: bytes


class Finding(msgspec.Struct, frozen=True):
    """What one run of an analysis found.

    Attributes:
        claims: at least one; the same ones in the same order whatever the seed.
        rows: of the analysis' table, at least one; the same ones, too.
        figures: in the order of the report; none where the run is not illustrated.
        notes: how it was measured, and what else there is to know; a paragraph each.
    """

    claims: tuple[Claim, ...]
    rows: tuple[Row, ...]
    figures: tuple[Figure, ...] = ()
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Context:
    """What a run may depend on beside its own code.

    Attributes:
        seed: of all that is random in it: the person who takes part.
        advance: called with the share of the work that is done, from 0 to 1.
        illustrated: figures are wanted.
    """

    seed: int
    advance: Callable[[float], None] = lambda _: None
    illustrated: bool = True

    def rng(self) -> np.random.Generator:
        """A new generator, the same one every time."""
        return np.random.default_rng(self.seed)

    def track(self, items: Sequence[Item]) -> Iterator[Item]:
        """The items, while progress is reported for each that is dealt with."""
        for i, item in enumerate(items):
            self.advance(i / len(items))
            yield item
        self.advance(1.0)

    def drawn(self, figures: Callable[[], Sequence[Figure]]) -> tuple[Figure, ...]:
        """The figures, which are drawn only where they are wanted."""
        return tuple(figures()) if self.illustrated else ()


@dataclass(frozen=True)
class Analysis:
    """One analysis of the thesis.

    Attributes:
        name: on the command line: short, lower case, hyphens.
        reference: where the thesis has it, such as "Fig. A.6".
        about: the question, in one line.
        claim: what the thesis found, in a sentence or two.
        run: makes it once. Depends on nothing but its argument, and draws with `services.reproduction.style`.
        seconds: of a processor that a run takes, roughly [s].
        person: a simulated person takes part, and every seed is another one; else one run says it all.
    """

    name: str
    reference: str
    about: str
    claim: str
    run: Callable[[Context], Finding]
    seconds: float
    person: bool = True
