"""How much comes through as pictures travel: as little is on the way as shows it.

So many chunks are on the way at once, at first as many as make a picture; twice as many where more came a second of
them than of half as many. Beyond that they would only wait, before others' as well.
"""

from __future__ import annotations

from collections.abc import Iterable

HELPS = 1.3
"""So many times as much has to come of twice as many: where less does, a queue stands."""

TRIES = 2
"""Of a number that does not help: a moment's pause of a machine shall not be taken for the way."""

FIRST, MOST = 4, 128
"""Chunks on the way at once."""

ROUND_NS = 200_000_000
"""So long it is looked at what comes at least, for it comes in bunches."""

STALLED_NS = 700_000_000
"""Where nothing comes for so long, nothing will."""


class Load:
    """Decides how much is sent, and what the way bears.

    Args:
        chunk_bytes: size of a chunk.
        most_bytes: in all.
        enough: where as much comes through as this, nobody needs to know how much more [byte/s].
        within_ns: it takes no longer [ns].
        now_ns: its beginning [ns].

    Attributes:
        rate: that comes through [byte/s]; 0 where that is not known.
        ended: nothing more is to be sent.
        grew: it ended while more on the way still helped: more may come through.
        sent: chunks so far.
        lost: of these, so far.
    """

    def __init__(self, chunk_bytes: int, most_bytes: int, enough: float, within_ns: int, now_ns: int) -> None:
        self.rate = 0.0
        self.ended = False
        self.grew = False
        self.sent = 0
        self.lost = 0
        self._chunk_bytes = chunk_bytes
        self._most = most_bytes // chunk_bytes
        self._enough = enough
        self._began_ns = self._heard_ns = now_ns
        self._ends_ns = now_ns + within_ns
        self._window = FIRST
        self._came = 0
        self._newest = -1
        self._round: list[int] = []
        self._tries = 0
        self._before = 0.0

    def step(self, now_ns: int, came: Iterable[tuple[int, int]] = ()) -> range:
        """The numbers of the chunks to send now.

        Args:
            now_ns: the time [ns].
            came: number of each chunk that came since the last step, and when [ns].
        """
        for number, received_ns in came:
            self._hear(number, received_ns)
        if now_ns > self._ends_ns or now_ns - self._heard_ns > STALLED_NS or self.lost:
            self._end()
        free = 0 if self.ended else self._window - (self.sent - 1 - self._newest)
        first = self.sent
        self.sent = min(self._most, self.sent + max(0, free))
        if not self.ended and self.sent == self._most and self._newest == self.sent - 1:
            self._end()
        return range(first, self.sent)

    def _hear(self, number: int, received_ns: int) -> None:
        if number <= self._newest or self.ended:
            return
        self.lost += number - self._newest - 1
        self._newest = number
        self._came += 1
        self._heard_ns = received_ns
        self._round.append(received_ns)
        # The first of a round were sent when fewer were on the way.
        measured = self._round[self._window :]
        if len(measured) > self._window and measured[-1] - measured[0] >= ROUND_NS:
            self._close_round((len(measured) - 1) * self._chunk_bytes / ((measured[-1] - measured[0]) / 1e9))

    def _close_round(self, rate: float) -> None:
        self._round.clear()
        self.rate = max(self.rate, rate)
        self._tries += 1
        self.grew = self.rate > HELPS * self._before
        if self.rate >= self._enough or (not self.grew and self._tries >= TRIES):
            self._end()
        elif self.grew and self._window < MOST:
            self._window *= 2
            self._tries, self._before = 0, self.rate

    def _end(self) -> None:
        if not self.rate and self._came:
            self.rate = self._came * self._chunk_bytes / ((self._heard_ns - self._began_ns) / 1e9)
        self.ended = True
