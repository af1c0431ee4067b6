"""What runs now: a participant's trial, as the pages see it and start it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from services.study.session.course import Adapt, Train


@dataclass(frozen=True)
class Live:
    """A trial that runs.

    Attributes:
        number: of the participant.
        part: its name.
        acting: the operator can act now.
        active: how long they could, in this part so far [s].
        attempts: executions so far, those before a resumption too.
        updates: of the model so far.
        lasted: since the part's begin, the interruptions of it left out, to the second [s].
        fault: what is wrong, one line for the experimenter; empty for nothing.
        ready: the station's page is there.
    """

    number: int
    part: str
    acting: bool
    active: float
    attempts: int
    updates: int
    lasted: int = 0
    fault: str = ""
    ready: bool = True


class Trials(Protocol):
    """Runs them, one at a time. It tells the conductor each attempt, and when a part is over.

    Whoever calls these holds the pages' lock (`services.study.page.desk.Desk`), and so does it when it tells the
    conductor something.
    """

    @property
    def url(self) -> str:
        """Of the station's page, which the participant's shows in a frame."""
        ...

    def start(self, number: int, part: Train | Adapt, language: str) -> None:
        """Run a part, from its last checkpoint where it has begun before.

        Args:
            number: of the participant.
            part: that has begun in the journal.
            language: of the participant's page.

        Raises:
            ServiceError: it cannot.
        """
        ...

    def stop(self, why: str) -> None:
        """End what runs, if anything does: the robot stands; the part is not over.

        Args:
            why: it is written down with an attempt that comes to no end.
        """
        ...

    def live(self) -> Live | None:
        """What runs now; None where nothing does."""
        ...
