"""What came of the executions of a skill: successes and how sure that is, why others failed, how long they took."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Self

import msgspec

from protocol.messages import Attempt
from services.offline.proportion import Proportion


class Tally(msgspec.Struct, frozen=True):
    """The executions of a skill.

    Attributes:
        skill: by its name.
        asked: how many were asked for.
        executed: how many came to their end.
        cut_short: how many were stopped or ended before; they say nothing of the skill.
        successes: of these.
        interval: 95 % interval of the probability of a success (Wilson).
        failures: how many failed by what.
        shortest_s: duration of an execution [s]; 0 where there was none.
        mean_s: the same on average.
        longest_s: the longest.
        reason: why there were fewer than asked for; empty where there were as many.
    """

    skill: str
    asked: int
    executed: int
    cut_short: int
    successes: int
    interval: tuple[float, float]
    failures: dict[str, int]
    shortest_s: float
    mean_s: float
    longest_s: float
    reason: str = ""

    @classmethod
    def of(cls, skill: str, asked: int, attempts: Sequence[tuple[Attempt, str]], reason: str) -> Self:
        """Count them.

        Args:
            skill: that was executed.
            asked: how many were asked for.
            attempts: each with what went wrong in it; empty where nothing did.
            reason: why it ended.
        """
        whole = [(attempt, fault) for attempt, fault in attempts if attempt.completed]
        failures = Counter(fault for _, fault in whole if fault)
        durations = [attempt.duration_s for attempt, _ in whole] or [0.0]
        successes = len(whole) - failures.total()
        return cls(
            skill=skill,
            asked=asked,
            executed=len(whole),
            cut_short=len(attempts) - len(whole),
            successes=successes,
            interval=Proportion(successes, len(whole)).interval,
            failures=dict(failures.most_common()),
            shortest_s=min(durations),
            mean_s=sum(durations) / len(durations),
            longest_s=max(durations),
            reason="" if len(whole) >= asked else reason or "it was ended",
        )

    @property
    def complete(self) -> bool:
        """There were as many as asked for."""
        return self.executed >= self.asked

    def lines(self) -> Iterator[str]:
        """For people."""
        held = Proportion(self.successes, self.executed)
        yield f"skill {self.skill}: {self.successes} of {self.executed} succeeded, {held}"
        for fault, count in self.failures.items():
            yield f"{count} failed: {fault}"
        if self.executed:
            yield f"each took {self.shortest_s:.1f} to {self.longest_s:.1f} s, {self.mean_s:.1f} s on average"
        if self.cut_short:
            yield f"{self.cut_short} cut short: that says nothing of the skill"
        if not self.complete:
            yield f"{self.executed} of {self.asked} were executed: {self.reason}"
