"""A questionnaire as a conductor takes it: what was filled in, and whether it is complete."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from services.study.values import Answer


class Questionnaire(Protocol):
    """What is filled in."""

    @property
    def version(self) -> str:
        """Of its file."""
        ...

    def check(self, answers: Mapping[str, Answer]) -> None:
        """Whether they are complete and allowed.

        Raises:
            AnswerRefused: they are not.
        """
        ...


@dataclass(frozen=True)
class Sheet:
    """A questionnaire that was filled in.

    Attributes:
        language: in which it was read.
        version: that was shown.
        shown: names of its questions, in the order in which they came.
        answers: by question.
    """

    language: str
    version: str
    shown: Sequence[str]
    answers: Mapping[str, Answer]
