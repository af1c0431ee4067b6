"""A questionnaire: a file of questions in several languages, and what it makes of answers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated

import msgspec
import numpy as np

from services.process.section import Section
from services.study.exceptions import AnswerRefused
from services.study.instruments.questions import MISSING, Pairs, Question, Scale, Words
from services.study.instruments.scoring import Score
from services.study.protocol.protocol import Name
from services.study.values import Answer


class Instrument(Section, frozen=True):
    """A questionnaire.

    Attributes:
        format: of the file.
        name: the file's.
        version: of its questions; what was answered in one is not mixed up with another.
        source: where it is from, and who may use it.
        title: by language.
        instructions: that stand before the questions, by language; empty for none.
        questions: in their order.
        shuffled: they come in a random order; pairs do always.
        scores: that are computed from the answers.
    """

    format: int
    name: Name
    version: Annotated[str, msgspec.Meta(min_length=1, max_length=40)]
    source: str
    title: Words
    questions: tuple[Question, ...]
    instructions: Words = msgspec.field(default_factory=dict)
    shuffled: bool = False
    scores: tuple[Score, ...] = ()

    def question(self, name: str) -> Question:
        """The question of that name, which there is."""
        return next(question for question in self.questions if question.name == name)

    def faults(self, answers: Mapping[str, Answer]) -> Iterator[tuple[str, str]]:
        """What keeps answers from being complete and allowed: each question or pair, and what is wrong with it."""
        wanted = {_pair(name): (name, question) for question in self.questions for name in question.answers}
        given = [_pair(name) for name in answers]
        for name, answer in answers.items():
            if _pair(name) not in wanted:
                yield name, f"{self.name} has no such question"
            elif given.count(_pair(name)) > 1:
                yield name, "it is answered twice"
            else:
                question = wanted[_pair(name)][1]
                fault = question.fault(answer, name) if isinstance(question, Pairs) else question.fault(answer)
                if fault and (question.required or fault != MISSING):
                    yield name, fault
        for pair, (name, question) in wanted.items():
            if question.required and pair not in given:
                yield name, MISSING

    def check(self, answers: Mapping[str, Answer]) -> None:
        """Whether they are complete and allowed.

        Raises:
            AnswerRefused: they are not.
        """
        for name, reason in self.faults(answers):
            raise AnswerRefused(name, reason)

    def scored(self, answers: Mapping[str, Answer]) -> dict[str, float]:
        """The scores of answers that were checked, by their names."""
        scales = {question.name: question for question in self.questions if isinstance(question, Scale)}
        return {score.name: score.value(answers, scales) for score in self.scores}


def shown_order(instrument: Instrument, rng: np.random.Generator) -> tuple[str, ...]:
    """Names of all answers in the order in which they are asked for; a pair's has its sides in their order.

    Args:
        instrument: that is shown.
        rng: of this participant and part.
    """
    places = range(len(instrument.questions))
    order = [int(place) for place in rng.permutation(len(places))] if instrument.shuffled else places
    return tuple(name for place in order for name in _shown(instrument.questions[place], rng))


def _shown(question: Question, rng: np.random.Generator) -> Sequence[str]:
    if not isinstance(question, Pairs):
        return question.answers
    pairs = [question.answers[place].split("/") for place in rng.permutation(len(question.answers))]
    return ["/".join(pair if rng.random() < 0.5 else reversed(pair)) for pair in pairs]


def _pair(name: str) -> tuple[str, ...]:
    """What a pair is called, whichever side is first."""
    return tuple(sorted(name.split("/")))
