"""When a part of a session is over, and how: pure functions of its attempts, one rule for people and simulated ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import takewhile

from services.study.events import Attempted
from services.study.protocol.protocol import Task, Training


@dataclass(frozen=True)
class Standing:
    """How a training stands.

    Attributes:
        attempts: that count: those of the robot alone do not.
        succeeded: of the last ones among which the rule asks for successes.
        left_s: of the time that it may take [s].
    """

    attempts: int
    succeeded: int
    left_s: float


def standing(attempts: Sequence[Attempted], rule: Training, lasted: float) -> Standing:
    """How a training stands.

    Args:
        attempts: so far.
        rule: of the protocol.
        lasted: since its begin, the interruptions of it left out [s].
    """
    led = [attempt.success for attempt in attempts if attempt.teaching is not None]
    return Standing(len(led), sum(led[-rule.of_last :]), max(0.0, 60.0 * rule.minutes - lasted))


def trained(attempts: Sequence[Attempted], rule: Training, lasted: float) -> bool | None:
    """Whether a training is passed; None while it goes on.

    Args:
        attempts: so far.
        rule: of the protocol.
        lasted: since its begin, the interruptions of it left out [s].
    """
    now = standing(attempts, rule, lasted)
    if now.succeeded >= rule.successes:
        return True
    return False if now.attempts >= rule.attempts or now.left_s == 0.0 else None


def adapted(attempts: Sequence[Attempted], task: Task) -> bool | None:
    """Whether a model is adapted: the robot alone has succeeded; None while it goes on.

    It is not where the robot alone failed after the last update that is allowed, or all attempts at one update did.

    Args:
        attempts: so far.
        task: of the protocol.
    """
    alone = attempts[-1] if attempts and attempts[-1].teaching is None else None
    if alone is not None and (alone.success or alone.updates >= task.updates):
        return alone.success
    at_this_update = takewhile(lambda attempt: attempt.teaching is not None, reversed(attempts))
    failed = sum(not attempt.success for attempt in at_this_update)
    return False if failed >= task.refinements else None
