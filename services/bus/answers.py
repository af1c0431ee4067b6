"""The answers that were given, by the requests' numbers: what is asked twice is done once.

An asker that got no answer asks again with the same number. It gets the answer that was given, or waits for the one
that is being made; the service never sees the second request.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, field

Respond = Callable[[bytes], None]

KEPT_NS = 600_000_000_000
"""Nobody asks again after this."""

KEPT = 1024
"""The oldest one gives way: an answer is asked for again within seconds, and so many changes take minutes."""

WAITING = 16
"""That wait for one answer; the oldest one has long given up."""


@dataclass
class _Answer:
    asked_ns: int
    payload: bytes | None = None
    waiting: list[Respond] = field(default_factory=list)


class Answers:
    """Of one query. The caller sees to it that one thread uses it at a time."""

    def __init__(self) -> None:
        self._answers: OrderedDict[int, _Answer] = OrderedDict()

    def open(self, number: int, respond: Respond, now_ns: int) -> bool:
        """Let a request wait for the answer to its number; whether it is the first one of it, to be carried out."""
        self._forget(now_ns)
        answer = self._answers.get(number)
        if answer is None:
            self._answers[number] = _Answer(now_ns, waiting=[respond])
            return True
        answer.waiting = [*answer.waiting, respond][-WAITING:]
        return False

    def close(self, number: int, payload: bytes | None = None) -> tuple[bytes, list[Respond]] | None:
        """Keep the answer to a number, and whom to give it to.

        Args:
            number: of the request.
            payload: the answer; by default the one that is kept, where there is one.

        Returns:
            None where there is no answer yet, or where the request was forgotten.
        """
        answer = self._answers.get(number)
        if answer is None:
            return None
        answer.payload = answer.payload if payload is None else payload
        if answer.payload is None:
            return None
        waiting, answer.waiting = answer.waiting, []
        return answer.payload, waiting

    def drop(self, number: int) -> None:
        """The request was not carried out, and can be asked again."""
        self._answers.pop(number, None)

    def _forget(self, now_ns: int) -> None:
        while self._answers:
            number, oldest = next(iter(self._answers.items()))
            if len(self._answers) < KEPT and now_ns - oldest.asked_ns <= KEPT_NS:
                return
            del self._answers[number]
