"""Whether a process that has ended is started again, and when: a pure function of how it ended before."""

from __future__ import annotations

import signal
from dataclasses import dataclass

from services.process.exceptions import KeepsFailing
from services.process.exit_codes import Exit

BACK_OFF_S = (0.2, 0.5, 1.0, 2.0, 5.0)
"""Waited before each new start in a row."""

STEADY_AFTER_S = 10.0
"""A process that lived so long begins with a clean record."""

TRIES = 5
"""So often in a row may a process end by itself; then the reason will not go away."""

KILLS = 50
"""So often in a row may it be killed from outside: by a person who tries it, or by a machine without memory."""

_KILLED = frozenset((-signal.SIGKILL, -signal.SIGTERM))


@dataclass(frozen=True)
class Again:
    """Start it again.

    Attributes:
        delay_s: to wait before [s].
        line: for people.
    """

    delay_s: float
    line: str


@dataclass(frozen=True)
class End:
    """A run's end.

    Attributes:
        line: which process, why, and what to do; empty where all is said.
        code: of the run.
    """

    line: str
    code: Exit


class Retries:
    """The record of one process.

    Args:
        name: of the process.
        lives: it is to live as long as the run; one that does a single thing and ends gets no clean record by taking
            long over it.
    """

    def __init__(self, name: str, *, lives: bool = True) -> None:
        self._name = name
        self._lives = lives
        self._failures = 0
        self._kills = 0

    def ended(self, code: int, lived_s: float, last_line: str) -> Again | End:
        """Judge an end that nobody asked for.

        Args:
            code: of the process; negative for the signal that killed it.
            lived_s: from its start [s].
            last_line: that it said.
        """
        if self._lives and lived_s > STEADY_AFTER_S:
            self._failures = self._kills = 0
        self._failures += code not in _KILLED
        self._kills += code in _KILLED
        said = last_line.removeprefix("retouch: ")
        for_ever = self._failures >= TRIES or self._kills >= KILLS
        times = max(self._failures, self._kills)
        delay_s = BACK_OFF_S[min(self._failures + self._kills, len(BACK_OFF_S)) - 1]
        match code:
            case Exit.BAD_INPUT | Exit.ENVIRONMENT:
                return End(f"{self._name}: {said or f'ended with code {code}'}", Exit(code))
            case Exit.TRY_AGAIN if for_ever:
                return End(f"{self._name}: {said} ({times} times in a row)", Exit.ENVIRONMENT)
            case Exit.TRY_AGAIN:
                return Again(delay_s, "tries again, for it may pass")
            case _ if for_ever:
                reason = f"{_ending(code)}, saying {said!r}" if said else _ending(code)
                return End(str(KeepsFailing(self._name, times, reason)), Exit.CRASHED)
            case _:
                return Again(delay_s, f"{_ending(code)}; starts again in {delay_s:g} s")


def _ending(code: int) -> str:
    return f"was killed by signal {-code}" if code < 0 else f"ended with code {code}"
