"""What the operator asks of the gripper while a motion runs: it counts until the motion itself comes to it.

So whoever closes the gripper a moment earlier moves that moment, and nothing else: where the motion would have closed
it they are one again, and where it opens it later it does. Nothing that is over or lost meanwhile, the part in which
corrections count, focus or link, undoes what was asked: it may hold something. Who asks for what the motion does just
now keeps it so when the motion goes on to something else, until it returns.
"""

from __future__ import annotations

SAME = 0.002
"""Openings that differ by less are one [m]."""


class Grasp:
    """In one motion."""

    def __init__(self) -> None:
        self._said: float | None = None

    def asked(
        self,
        said: float | None,
        kept: float | None,
        own: tuple[float | None, float | None],
        *,
        counts: bool = True,
    ) -> float | None:
        """The opening in place of the motion's own [m]; None where that counts.

        Args:
            said: by the operator now [m]; None where nothing is. Only another one than before is a new wish.
            kept: that was in place of the motion's own so far [m]; None where that counted.
            own: the motion's own opening before and now [m].
            counts: what is said now; else it counts later neither.
        """
        new = counts and said is not None and said != self._said
        self._said = said
        before, now = own
        if now is None or before is None:
            return said if new else kept
        if new and said is not None:
            return None if kept is not None and abs(now - said) < SAME else said
        return None if kept is not None and _comes_to(kept, before, now) else kept


def _comes_to(opening: float, before: float, now: float) -> bool:
    """Whether a motion has just come to an opening, or passed it."""
    there, was_there = abs(now - opening) < SAME, abs(before - opening) < SAME
    return not was_there and (there or (before - opening) * (now - opening) < 0.0)
