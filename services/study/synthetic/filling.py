"""How a synthetic participant fills in questionnaires: the load that a method was, told in a style of their own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import assert_never

import numpy as np

from services.study.instruments.instrument import Instrument, shown_order
from services.study.instruments.questions import Choice, Number, Pairs, Question, Scale, Text
from services.study.synthetic.character import Nature
from services.study.values import Answer

EASY, HARD = 20.0, 80.0
"""Load of a method that went at once, and of one at which everything failed, in points of 100."""

LONG_S = 240.0
"""Acting for so long with a method is half as hard as it gets [s]."""


@dataclass(frozen=True)
class Experience:
    """What a method was to somebody.

    Attributes:
        seconds: that they acted.
        failed: share of their attempts that failed.
    """

    seconds: float
    failed: float

    @property
    def load(self) -> float:
        """In points of 100."""
        effort = self.seconds / (self.seconds + LONG_S)
        return EASY + (HARD - EASY) * (0.5 * effort + 0.5 * self.failed)


def filled(
    instrument: Instrument, nature: Nature, part: int, experience: Experience | None
) -> tuple[tuple[str, ...], dict[str, Answer]]:
    """The questions in the order in which they came, and the answers.

    Args:
        instrument: that is filled in.
        nature: of the participant.
        part: of the session, so that no two are alike.
        experience: with the method that it is about; None for none.
    """
    rng = np.random.default_rng((nature.seed, 12, part))
    shown = shown_order(instrument, rng)
    load = experience.load if experience is not None else 50.0
    answers: dict[str, Answer] = {}
    for question in instrument.questions:
        answers |= _answers(question, nature, load, rng)
    return shown, {name: answers[name] for name in sorted(answers)}


def _answers(question: Question, nature: Nature, load: float, rng: np.random.Generator) -> Mapping[str, Answer]:
    match question:
        case Scale():
            said = np.clip(rng.normal(load + nature.severity, nature.spread), 0.0, 100.0) / 100.0
            return {question.name: _nearest(question.ticks, question.low + said * (question.high - question.low))}
        case Choice():
            return {question.name: question.options[int(rng.integers(len(question.options)))].name}
        case Text():
            return {question.name: "synthetic"} if question.required else {}
        case Number():
            said = rng.uniform(question.low, question.high)
            return {question.name: round(said) if question.whole else round(said, 1)}
        case Pairs():
            return {name: name.split("/")[int(rng.integers(2))] for name in question.answers}
    assert_never(question)


def _nearest(ticks: Sequence[float], value: float) -> float:
    return min(ticks, key=lambda tick: abs(tick - value))
