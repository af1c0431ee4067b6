"""What the robot was asked to do, and what became of it."""

from __future__ import annotations

from dataclasses import dataclass

from protocol.messages import Mode
from services.robot.episode import EpisodeOutcome


@dataclass(frozen=True)
class Order:
    """What was asked for, and the number that it got.

    Attributes:
        episode: counted since the process started.
        request: number that the asker gave it.
        mode: who shapes the motion.
        prediction: id of what is to be executed; 0 where the operator's hand leads alone.
        holder: of the authority who asked.
        who: the same for people.
    """

    episode: int
    request: int
    mode: Mode
    prediction: int
    holder: str
    who: str


@dataclass(frozen=True, eq=False)
class Finished:
    """An order and what became of it."""

    order: Order
    outcome: EpisodeOutcome
