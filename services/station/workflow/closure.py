"""Whether the loop has closed: a prediction failed, was refined, learnt, and a later one succeeded by itself.

Where a skill was empty there was nothing to predict from: the first motion that an operator shows answers that.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from protocol.messages import Attempt, Mode

SAME_PLACE_M = 0.02
"""Two sightings of an object that nobody moved differ by a few millimetres."""

FAILURES_KEPT = 32
"""A day's run goes through any number of places; the loop closes at one of the newest."""


@dataclass(frozen=True)
class Failure:
    """A prediction that failed first at its place, and under which model a refinement has succeeded since.

    Attributes:
        attempt: the failed one.
        refined: the oldest of these models' versions; None before the first.
    """

    attempt: Attempt
    refined: int | None = None

    def is_answered_by(self, later: Attempt) -> bool:
        """A success at the failure's place, under a newer model than the refinement's."""
        return self.refined is not None and later.model_version > self.refined and _same_place(self.attempt, later)


@dataclass(frozen=True)
class Closure:
    """What has to be remembered of a run to see the loop close; it does not grow with the run.

    Attributes:
        closed: it has closed.
        failures: that a success would answer, the newest places of them.
    """

    closed: bool = False
    failures: tuple[Failure, ...] = ()

    def after(self, attempt: Attempt, *, empty: bool = False) -> Closure:
        """With one more episode.

        Args:
            attempt: the episode.
            empty: nothing had been learnt by then.
        """
        if self.closed:
            return self
        success, alone = attempt.verdict.success, attempt.mode is Mode.AUTONOMOUS
        if empty:
            return self._failed(attempt)._refined(attempt.model_version) if success else self
        if alone and not success:
            return self._failed(attempt)
        if alone and not attempt.operator_input and any(failure.is_answered_by(attempt) for failure in self.failures):
            return Closure(closed=True)
        if not alone and success and attempt.operator_input:
            return self._refined(attempt.model_version)
        return self

    def _failed(self, attempt: Attempt) -> Closure:
        if any(_same_place(failure.attempt, attempt) for failure in self.failures):
            return self
        return replace(self, failures=(*self.failures, Failure(attempt))[-FAILURES_KEPT:])

    def _refined(self, version: int) -> Closure:
        refined = tuple(
            replace(failure, refined=version if failure.refined is None else min(failure.refined, version))
            for failure in self.failures
        )
        return replace(self, failures=refined)


def _same_place(one: Attempt, other: Attempt) -> bool:
    return (
        one.variant == other.variant
        and one.condition == other.condition
        and all(abs(a - b) <= SAME_PLACE_M for a, b in zip(one.object_position, other.object_position, strict=True))
    )
