"""When a running episode holds, and when it goes on again: by itself after a moment, else only when it is asked to."""

from __future__ import annotations

LONG_HOLD_S = 0.5
"""A hold of more than this is left only upon a request [s]."""

ASK = "waits to be asked to go on"


class Hold:
    """Follows the reasons to hold of one episode after another.

    A motion belongs to the authority under which somebody asked for it: under another one, the same person's included,
    it waits to be asked again.
    """

    def __init__(self) -> None:
        self.waiting = False
        self._epoch = 0
        self._since_ns: int | None = None

    def ask(self, epoch: int) -> None:
        """Somebody asked for the motion, or for it to go on.

        Args:
            epoch: of the authority under which.
        """
        self.waiting = False
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
        self.waiting = self.waiting or epoch != self._epoch or held_ns > LONG_HOLD_S * 1e9
        return cause or (ASK if self.waiting else "")
