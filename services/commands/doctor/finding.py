"""What a check has found: one line for people."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from services.process.lines import readable


class Verdict(Enum):
    """How it stands with something.

    OK: as it should be.
    LOOK: it works, and a person should know.
    WRONG: it does not work.
    NOT_MADE: the check could not be made, because of an earlier one.
    """

    OK = "ok"
    LOOK = "look at this"
    WRONG = "wrong"
    NOT_MADE = "not made"


_WIDTH = max(len(verdict.value) for verdict in Verdict)


@dataclass(frozen=True)
class Finding:
    """One line.

    Attributes:
        verdict: how it stands.
        check: of what.
        found: what was found.
        remedy: what to do; empty where that is nothing.
    """

    verdict: Verdict
    check: str
    found: str
    remedy: str = ""

    @property
    def line(self) -> str:
        """As it is printed; what came over a network does nothing at a terminal."""
        told = f"{self.found}; {self.remedy}" if self.remedy else self.found
        return f"{self.verdict.value:{_WIDTH}}  {readable(f'{self.check}: {told}')}"


def ok(check: str, found: str) -> Finding:
    """It is as it should be."""
    return Finding(Verdict.OK, check, found)


def look(check: str, found: str, remedy: str = "") -> Finding:
    """It works, and a person should know."""
    return Finding(Verdict.LOOK, check, found, remedy)


def wrong(check: str, found: str, remedy: str) -> Finding:
    """It does not work."""
    return Finding(Verdict.WRONG, check, found, remedy)
