"""What those who look need of the pictures, whether they come through or not."""

from __future__ import annotations

from typing import NamedTuple

from protocol.topics import PICTURE_QUEUE
from services.bus.bus import Bus
from services.bus.senders import Senders


class Wish(NamedTuple):
    """Of all who look, taken together.

    Attributes:
        jpeg_only: somebody can show nothing else.
        key: somebody has lost a picture that others need.
    """

    jpeg_only: bool = False
    key: bool = False


class Wishes:
    """Follows who looks.

    Args:
        bus: on which they tell.
    """

    def __init__(self, bus: Bus) -> None:
        self._told = Senders(bus.subscribe(PICTURE_QUEUE), lambda queue: queue.process)

    def at(self, now_ns: int) -> Wish:
        """As it is now."""
        told = [received.message for received in self._told.there(now_ns).values()]
        return Wish(any(one.jpeg_only for one in told), any(one.waits for one in told))
