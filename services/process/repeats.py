"""What is said again and again: a few lines of a kind are told, the rest is counted, and the count is told later."""

from __future__ import annotations

import re
from dataclasses import dataclass

MOST = 3
"""Lines of one kind that are told within a while."""

WHILE_S = 60.0
"""The while: then the count of those that were not told is told, and the kind is told again."""

KINDS_KEPT = 256
"""Kinds that are remembered at most: of more than that the oldest is forgotten."""

_FIGURES = re.compile(r"\d+")


@dataclass
class _Kind:
    """Of lines.

    Attributes:
        line: the last of them.
        since_s: when the first of this while was said [s].
        said: how many were.
    """

    line: str
    since_s: float
    said: int = 0

    @property
    def counted(self) -> str:
        """How many were not told, in a line; empty where all were."""
        left_out = self.said - MOST
        return f"{left_out} more like this in {WHILE_S:.0f} s: {self.line}" if left_out > 0 else ""


class Repeats:
    """Says which lines to tell. Lines that differ only in their figures are of one kind."""

    def __init__(self) -> None:
        self._kinds: dict[str, _Kind] = {}

    def told(self, line: str, now_s: float) -> tuple[str, ...]:
        """What to tell now that a line was said: it, unless it is one too many, and the counts that are due before it.

        Args:
            line: that was said.
            now_s: when, by a clock that only goes on [s].
        """
        counts = self.due(now_s)
        name = _FIGURES.sub("#", line)
        kind = self._kinds.get(name)
        if kind is None:
            if len(self._kinds) >= KINDS_KEPT:
                counts += tuple(filter(None, (self._kinds.pop(next(iter(self._kinds))).counted,)))
            kind = self._kinds[name] = _Kind(line, now_s)
        kind.line = line
        kind.said += 1
        return (*counts, line) if kind.said <= MOST else counts

    def due(self, now_s: float) -> tuple[str, ...]:
        """The counts whose while is over."""
        over = [name for name, kind in self._kinds.items() if now_s - kind.since_s >= WHILE_S]
        return self._counts(over)

    def rest(self) -> tuple[str, ...]:
        """The counts that are left, where nothing more comes."""
        return self._counts(list(self._kinds))

    def _counts(self, names: list[str]) -> tuple[str, ...]:
        kinds = [self._kinds.pop(name) for name in names]
        return tuple(kind.counted for kind in kinds if kind.counted)
