"""Scores: what a questionnaire's file says is to be computed from its answers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import Annotated

import msgspec

from services.process.section import Section
from services.study.instruments.questions import Scale
from services.study.protocol.protocol import Name
from services.study.values import Answer

Range = Annotated[tuple[float, ...], msgspec.Meta(max_length=2)]


class Mean(Section, frozen=True, kw_only=True, tag_field="kind", tag="mean"):
    """The mean of several scales.

    Attributes:
        name: as tables and hypotheses have it.
        of: names of the scales.
        reversed: those of them that count the other way round.
        range: onto which each scale is stretched first: [0, 100]; empty for as it is.
    """

    name: Name
    of: tuple[Name, ...]
    reversed: tuple[Name, ...] = ()
    range: Range = ()

    def value(self, answers: Mapping[str, Answer], scales: Mapping[str, Scale]) -> float:
        """Of answers that were checked; scales that need no answer and have none do not count, NaN where none has.

        Args:
            answers: by question.
            scales: by their names.
        """
        ratings = [self._rating(float(answers[name]), scales[name]) for name in self.of if name in answers]
        return sum(ratings) / len(ratings) if ratings else float("nan")

    def _rating(self, answer: float, scale: Scale) -> float:
        rating = scale.low + scale.high - answer if scale.name in self.reversed else answer
        if not self.range:
            return rating
        low, high = self.range
        return low + (high - low) * (rating - scale.low) / (scale.high - scale.low)


class Weighted(Section, frozen=True, kw_only=True, tag_field="kind", tag="weighted"):
    """The mean of the scales that were compared in pairs, each weighted by how often it was chosen.

    S. G. Hart and L. E. Staveland, Development of NASA-TLX, 1988: with six scales the weights sum to 15.

    Attributes:
        name: as tables and hypotheses have it.
        pairs: name of the question with the pairs.
        of: names of the scales, those of the pairs.
    """

    name: Name
    pairs: Name
    of: tuple[Name, ...]

    def value(self, answers: Mapping[str, Answer], scales: Mapping[str, Scale]) -> float:
        """Of answers that were checked; NaN where there are no pairs among them.

        Args:
            answers: by question.
            scales: by their names.
        """
        del scales
        weights = self.weights(answers)
        chosen = sum(weights.values())
        return sum(weights[name] * float(answers[name]) for name in self.of) / chosen if chosen else float("nan")

    def weights(self, answers: Mapping[str, Answer]) -> Counter[str]:
        """How often each scale was chosen.

        Args:
            answers: by question.
        """
        pairs = {
            name: answer for name, answer in answers.items() if "/" in name and set(name.split("/")) <= set(self.of)
        }
        return Counter(str(answer) for answer in pairs.values())


Score = Mean | Weighted
