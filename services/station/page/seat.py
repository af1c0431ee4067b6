"""Who sits at the operator's desk. Others look on, and nobody comes to sit without a press but the first.

A tab whose link or page was lost finds its seat again. Who wants the seat of somebody else asks for it: whoever sits
gives it or keeps it, and silence gives it; or takes it at once, with a reason.
"""

from __future__ import annotations

from dataclasses import dataclass

from protocol.messages import SILENCE_GIVES_S

RESERVED_NS = 30_000_000_000
"""How long the seat is kept for a tab that is gone: a press takes it at once only after that."""

ASKED_NS = round(SILENCE_GIVES_S * 1e9)
"""Silence for so long gives the seat to who asked for it."""


@dataclass(frozen=True)
class Question:
    """Somebody wants the seat.

    Attributes:
        tab: that asked.
        token: by which it finds the seat again.
        since_ns: when it asked.
    """

    tab: int
    token: str
    since_ns: int


class Seat:
    """The one seat from which the robot is commanded.

    Attributes:
        tab: that sits here; None while it is gone, or where nobody ever sat.
        question: who asks for it; None where nobody does.
        token: by which whoever sat last finds the seat again; empty where nobody ever did.
        kept_from: the tab that asked last and was told that the seat is kept; None where none was.
    """

    def __init__(self) -> None:
        self.tab: int | None = None
        self.question: Question | None = None
        self.kept_from: int | None = None
        self.token = ""
        self._left_ns = 0

    def enter(self, tab: int, token: str) -> bool:
        """A tab has come, or come back with the token by which it finds its seat; whether it sits now."""
        if self.token and token != self.token:
            return False
        self._sit(tab, token)
        return True

    def leave(self, tab: int, now_ns: int) -> bool:
        """A tab has gone: its seat stays empty, its question is not asked any more; whether it sat."""
        if self.question is not None and self.question.tab == tab:
            self.question = None
        if tab != self.tab:
            return False
        self.tab = None
        self._left_ns = now_ns
        return True

    def ask(self, tab: int, token: str, now_ns: int) -> bool:
        """A tab wants the seat; whether it sits now, because the seat was nobody's any more."""
        if tab == self.tab or self.question is not None:
            return False
        if self.tab is None and now_ns - self._left_ns > RESERVED_NS:
            self._sit(tab, token)
            return True
        self.question = Question(tab, token, now_ns)
        self.kept_from = None
        return False

    def take(self, tab: int, token: str) -> bool:
        """A tab takes the seat at once; whether it did not have it."""
        if tab == self.tab:
            return False
        self._sit(tab, token)
        return True

    def get_up(self, tab: int) -> bool:
        """A tab wants the seat no more: whoever asks for it has it, and whoever presses for it next; whether it sat."""
        if tab != self.tab:
            self.leave(tab, 0)
            return False
        if not self.give():
            self.leave(tab, -RESERVED_NS - 1)
        return True

    def give(self) -> bool:
        """Who sits gives the seat to who asked for it; whether somebody did."""
        if self.question is None:
            return False
        self._sit(self.question.tab, self.question.token)
        return True

    def keep(self) -> None:
        """Who sits keeps the seat."""
        if self.question is not None:
            self.kept_from = self.question.tab
            self.question = None

    def expire(self, now_ns: int) -> bool:
        """Silence gives the seat; whether it did."""
        return self.left_ns(now_ns) <= 0 and self.give()

    def left_ns(self, now_ns: int) -> int:
        """Until silence answers the question; 0 where there is none. Nobody's seat is kept only for whoever left it."""
        if self.question is None:
            return 0
        asked_ns = ASKED_NS - (now_ns - self.question.since_ns)
        return asked_ns if self.tab is not None else min(asked_ns, RESERVED_NS + 1 - (now_ns - self._left_ns))

    def _sit(self, tab: int, token: str) -> None:
        self.tab = tab
        self.question = None
        self.kept_from = None
        self.token = token
