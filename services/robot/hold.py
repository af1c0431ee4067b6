"""When a running episode holds, and when it goes on again: by itself after a moment, else only when it is asked to."""

from __future__ import annotations

LONG_HOLD_S = 0.5
"""A hold of more than this is left only upon a request [s]."""

TOO_LONG = f"it held for more than {LONG_HOLD_S:g} s"
ANOTHER_AUTHORITY = "it was asked for under another authority"
"""Why an episode waits that nothing keeps any more."""


class Hold:
    """Follows the reasons to hold of one episode after another.

    A motion belongs to the authority under which somebody asked for it: under another one, the same person's included,
    it waits to be asked again.
    """

    def __init__(self) -> None:
        self._waits = ""
        self._epoch = 0
        self._since_ns: int | None = None

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
        self._since_ns = None

    def reason(self, now_ns: int, cause: str, epoch: int) -> str:
        """Why the episode has to hold in this period; empty where it may go on.

        Args:
            now_ns: the time.
            cause: what keeps it from going on now, empty where nothing does.
            epoch: of the authority now.
        """
        if not cause:
            self._since_ns = None
        elif self._since_ns is None:
            self._since_ns = now_ns
        held_ns = now_ns - self._since_ns if self._since_ns is not None else 0
        if epoch != self._epoch:
            self._waits = ANOTHER_AUTHORITY
        elif held_ns > LONG_HOLD_S * 1e9:
            self._waits = self._waits or TOO_LONG
        return cause or self._waits
