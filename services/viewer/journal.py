"""What happened, in words: changes of phase, verdict and teaching, once each."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from protocol.messages import Phase, RobotState, TeachingState, Verdict


class Entry(NamedTuple):
    """A line of the journal.

    Attributes:
        text: for people.
        level: "INFO", "WARN" or "ERROR".
    """

    text: str
    level: str


class Journal:
    """Remembers what was said, and says what is new."""

    def __init__(self) -> None:
        self._said: dict[str, str] = {}

    def robot(self, state: RobotState) -> Iterator[Entry]:
        """What is new about the robot."""
        phase = f"robot: {state.phase.value}" + (f", episode {state.episode}" if state.episode else "")
        level = "ERROR" if state.phase is Phase.STOPPED else "INFO"
        yield from self._changed("robot", Entry(f"{phase}: {state.hold_reason}" if state.hold_reason else phase, level))

    def verdict(self, verdict: Verdict) -> Iterator[Entry]:
        """What is new about the criteria."""
        collision = f"collision, {verdict.collision_force:.0f} N" if verdict.collision else "no collision"
        yield from self._changed("collision", Entry(collision, "ERROR" if verdict.collision else "INFO"))
        kicked = "object kicked over" if verdict.kicked_over else "object in place"
        yield from self._changed("kicked", Entry(kicked, "ERROR" if verdict.kicked_over else "INFO"))
        yield from self._changed(
            "reached", Entry("object reached" if verdict.reached else "object not reached", "INFO")
        )

    def teaching(self, state: TeachingState) -> Iterator[Entry]:
        """What is new about the teaching."""
        yield from self._changed("teaching", Entry(f"{state.phase}: {state.text}", "INFO"))
        if state.reason:
            yield from self._changed("reason", Entry(state.reason, "WARN"))

    def _changed(self, subject: str, entry: Entry) -> Iterator[Entry]:
        if self._said.get(subject) != entry.text:
            self._said[subject] = entry.text
            yield entry
