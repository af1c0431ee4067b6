"""The kinds of questions: what each allows for an answer."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import combinations
from typing import Annotated, TypeGuard

import msgspec

from services.process.section import Positive, Section
from services.study.protocol.protocol import Name
from services.study.values import Answer

LONGEST = 4000
"""Of a text, as the journal takes it."""

MISSING = "there is no answer"

Words = dict[Annotated[str, msgspec.Meta(min_length=2, max_length=12)], Annotated[str, msgspec.Meta(min_length=1)]]
"""A text, by language."""


def in_english(words: Mapping[str, str]) -> str:
    """A text for readers of the data: in English, or else in its first language; empty where there is none."""
    return words.get("en") or next(iter(words.values()), "")


class _Question(Section, frozen=True, kw_only=True, tag_field="kind"):
    """Base of all of them.

    Attributes:
        name: short, as tables have it.
        text: the question, by language.
        about: what it means, by language; empty where the question says it.
        required: the form is not complete without it.
    """

    name: Name
    text: Words
    about: Words = msgspec.field(default_factory=dict)
    required: bool = True

    @property
    def answers(self) -> tuple[str, ...]:
        """Names of the answers that it wants."""
        return (self.name,)

    @property
    def words(self) -> Iterator[Words]:
        """All its texts; one that it does without is left out."""
        yield self.text
        if self.about:
            yield self.about


class Scale(_Question, frozen=True, kw_only=True, tag="scale"):
    """A line with ticks.

    Attributes:
        low: value of the first tick.
        high: of the last one.
        step: between two of them.
        left: what the first one means.
        right: what the last one means.
        numbered: the value stands at each tick; else they are only lines.
    """

    left: Words
    right: Words
    low: float = 1.0
    high: float = 5.0
    step: Positive = 1.0
    numbered: bool = False

    @property
    def ticks(self) -> tuple[float, ...]:
        """Their values."""
        return tuple(self.low + number * self.step for number in range(round((self.high - self.low) / self.step) + 1))

    @property
    def words(self) -> Iterator[Words]:
        """All its texts."""
        yield from super().words
        yield from (self.left, self.right)

    def fault(self, answer: Answer) -> str:
        """What is wrong with an answer; empty where nothing is."""
        if not _is_number(answer):
            return "a number is wanted"
        if any(math.isclose(answer, tick, abs_tol=1e-9) for tick in self.ticks):
            return ""
        return f"{answer:g} is none of its ticks: {self.low:g} to {self.high:g} in steps of {self.step:g}"


class Option(Section, frozen=True):
    """One of several answers.

    Attributes:
        name: that is recorded.
        text: that is read, by language.
    """

    name: Name
    text: Words


class Choice(_Question, frozen=True, kw_only=True, tag="choice"):
    """One of several.

    Attributes:
        options: that there are.
        among: "methods" for those of the protocol, by their names, in the place of options.
    """

    options: tuple[Option, ...] = ()
    among: Annotated[str, msgspec.Meta(pattern="^(|methods)$")] = ""

    @property
    def words(self) -> Iterator[Words]:
        """All its texts."""
        yield from super().words
        yield from (option.text for option in self.options)

    def fault(self, answer: Answer) -> str:
        """What is wrong with an answer; empty where nothing is."""
        names = [option.name for option in self.options]
        return "" if answer in names else f"{answer!r} is not offered, only {', '.join(names)}"


class Text(_Question, frozen=True, kw_only=True, tag="text"):
    """In the participant's words.

    Attributes:
        longest: that it may be, in characters.
        lines: of the field.
    """

    longest: Annotated[int, msgspec.Meta(ge=1, le=LONGEST)] = 200
    lines: Annotated[int, msgspec.Meta(ge=1, le=20)] = 1

    def fault(self, answer: Answer) -> str:
        """What is wrong with an answer; empty where nothing is."""
        if not isinstance(answer, str):
            return "a text is wanted"
        if not answer.strip():
            return MISSING
        return "" if len(answer) <= self.longest else f"it has {len(answer)} characters, of at most {self.longest}"


class Number(_Question, frozen=True, kw_only=True, tag="number"):
    """A number.

    Attributes:
        low: the smallest that is allowed.
        high: the largest.
        whole: it has no fraction.
    """

    low: float
    high: float
    whole: bool = True

    def fault(self, answer: Answer) -> str:
        """What is wrong with an answer; empty where nothing is."""
        if not _is_number(answer):
            return "a number is wanted"
        if self.whole and answer != round(answer):
            return f"{answer:g} is no whole number"
        return "" if self.low <= answer <= self.high else f"{answer:g} is outside {self.low:g} to {self.high:g}"


class Pairs(_Question, frozen=True, kw_only=True, tag="pairs"):
    """Of every two of several scales: which one counts more.

    A pair's answer is called "first/second", in the order in which its two sides were shown, and is one of both names.

    Attributes:
        of: names of the scales.
    """

    of: tuple[Name, ...]

    @property
    def answers(self) -> tuple[str, ...]:
        """Names of the answers that it wants, in one of two orders each."""
        return tuple(f"{first}/{second}" for first, second in combinations(self.of, 2))

    def fault(self, answer: Answer, pair: str = "") -> str:
        """What is wrong with an answer to a pair; empty where nothing is."""
        return "" if answer in pair.split("/") else f"{answer!r} is none of the two"


Question = Scale | Choice | Text | Number | Pairs


def _is_number(answer: Answer) -> TypeGuard[int | float]:
    return isinstance(answer, int | float) and not isinstance(answer, bool) and math.isfinite(answer)
