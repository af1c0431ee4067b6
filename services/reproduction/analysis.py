"""What an analysis of the thesis is, and what it finds when it is made again."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import TypeVar

import msgspec
import numpy as np

Item = TypeVar("Item")

Value = float | str | None
"""A measured number, a text where a number does not say it, or nothing where the question does not arise."""


class Holds(Enum):
    """Whether what the thesis claims was found again."""

    YES = "yes"
    NO = "no"
    DIFFERS = "differs"


class Row(msgspec.Struct, frozen=True):
    """One quantity, three times.

    Attributes:
        quantity: what was measured, and where.
        unit: of the numbers; empty where they have none.
        thesis: what the thesis reports.
        conditioned: of the thesis' method here, `lfd.models.promp.ConditionedProMP`.
        adaptive: of the default model here, `lfd.models.adaptive.adaptation.AdaptiveProMP`.
    """

    quantity: str
    unit: str = ""
    thesis: Value = None
    conditioned: Value = None
    adaptive: Value = None


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
    """What an analysis found.

    Attributes:
        holds: whether the thesis' claim was found again.
        sentence: in what way.
        rows: of the report's table, at least one.
        figures: in the order of the report.
        notes: how it was measured, and what else there is to know; a paragraph each.
    """

    holds: Holds
    sentence: str
    rows: tuple[Row, ...]
    figures: tuple[Figure, ...] = ()
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Context:
    """What an analysis may depend on beside its own code.

    Attributes:
        seed: of all that is random in it.
        advance: called with the share of the work that is done, from 0 to 1.
    """

    seed: int
    advance: Callable[[float], None] = lambda _: None

    def rng(self) -> np.random.Generator:
        """A new generator, the same one every time."""
        return np.random.default_rng(self.seed)

    def track(self, items: Sequence[Item]) -> Iterator[Item]:
        """The items, while progress is reported for each that is dealt with."""
        for i, item in enumerate(items):
            self.advance(i / len(items))
            yield item
        self.advance(1.0)


@dataclass(frozen=True)
class Analysis:
    """One analysis of the thesis.

    Attributes:
        name: on the command line: short, lower case, hyphens.
        reference: where the thesis has it, such as "Fig. A.6".
        about: the question, in one line.
        claim: what the thesis found, in a sentence or two.
        run: makes it again. Depends on nothing but its argument, and draws with `services.reproduction.style`.
    """

    name: str
    reference: str
    about: str
    claim: str
    run: Callable[[Context], Finding]
