"""When a running episode holds, and when it goes on again: by itself after a moment, else only when it is asked to."""

from __future__ import annotations

LONG_HOLD_S = 0.5
"""A hold of more than this is left only upon a request [s]."""

TOO_LONG = f"it held for more than {LONG_HOLD_S:g} s"
ANOTHER_AUTHORITY = "it was asked for under another authority"
"""Why an episode waits; behind it stands in parentheses what had kept the motion, where something had."""


class Hold:
    """Follows the reasons to hold of one episode after another.

    A motion belongs to the authority under which somebody asked for it: under another one, the same person's included,
    it waits to be asked again. Why it waits is said in the same words until it is asked, whatever comes and goes for a
    moment meanwhile: whoever is to answer has to be able to read it.
    """

    def __init__(self) -> None:
        self._waits = ""
        self._kept_by = ""
        self._epoch = 0
        self._held_since_ns: int | None = None
        self._cause = ""
        self._cause_since_ns = 0

    @property
    def waiting(self) -> bool:
        """The episode goes on only when it is asked to."""
        return bool(self._waits)

    def ask(self, epoch: int) -> None:
        """Somebody asked for the motion, or for it to go on.

        Args:
            epoch: of the authority under which.
        """
        self._waits = ""
        self._epoch = epoch
        self._held_since_ns = None

    def reason(self, now_ns: int, cause: str, epoch: int) -> str:
        """Why the episode has to hold in this period; empty where it may go on.

        Args:
            now_ns: the time.
            cause: what keeps it from going on now, empty where nothing does.
            epoch: of the authority now.
        """
        if not cause:
            self._held_since_ns = None
        elif self._held_since_ns is None:
            self._held_since_ns = now_ns
        if cause != self._cause:
            self._cause, self._cause_since_ns = cause, now_ns
        waits = self._why_it_waits(now_ns, epoch)
        if waits != self._waits or (cause and _is_long(self._cause_since_ns, now_ns)):
            self._kept_by = cause
        self._waits = waits
        if not waits:
            return cause
        return f"{waits} ({self._kept_by})" if self._kept_by else waits

    def _why_it_waits(self, now_ns: int, epoch: int) -> str:
        if epoch != self._epoch:
            return ANOTHER_AUTHORITY
        long = self._held_since_ns is not None and _is_long(self._held_since_ns, now_ns)
        return self._waits or (TOO_LONG if long else "")


def _is_long(since_ns: int, now_ns: int) -> bool:
    return now_ns - since_ns > LONG_HOLD_S * 1e9
