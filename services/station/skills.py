"""Asks the model which skills the robot has: when another one is in use, when one has changed, and now and then."""

from __future__ import annotations

from typing import Any

from protocol import queries
from protocol.messages import ModelState
from protocol.queries import ListSkills, SkillsListed
from services.bus.bus import Bus, Pending

TIMEOUT_S = 2.0
AGAIN_NS = 10_000_000_000
"""After a list: others are made and dropped at a terminal, of which nobody tells."""

SOON_NS = 1_000_000_000
"""After no answer."""


class SkillsReader:
    """What is known of the robot's skills.

    Args:
        bus: to the model.
    """

    def __init__(self, bus: Bus) -> None:
        self._bus = bus
        self._asked: Pending[Any] | None = None
        self._of: tuple[str, int] = ("", -1)
        self._next_ns = 0
        self.listed: SkillsListed | None = None

    def step(self, now_ns: int, model: ModelState | None) -> None:
        """Take what has come, and ask where that is due: one question at a time."""
        if self._asked is not None:
            outcome = self._asked.poll()
            if outcome is None:
                return
            self._asked = None
            if isinstance(outcome, SkillsListed):
                self.listed = outcome
            else:
                self._next_ns = now_ns + SOON_NS
        if model is None:
            return
        of = model.skill, model.version
        if of != self._of or now_ns >= self._next_ns:
            self._of, self._next_ns = of, now_ns + AGAIN_NS
            self._asked = self._bus.ask(queries.SKILLS, ListSkills(), TIMEOUT_S)
