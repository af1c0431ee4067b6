"""The lanes of a process to its router: on a network, what may be late never stands before what may not.

Pictures have a link of their own: the priorities of one stream do not help what waits behind them in the kernel. What
comes again within a moment goes as datagrams, where the network lets them through. On one machine one link is enough.
"""

from __future__ import annotations

import threading
from typing import Any

from protocol.topic import QoS, Topic
from services.bus.zenoh.datagrams import Datagrams
from services.bus.zenoh.session import Session, open_session

OPEN_S = 30.0
"""To open the pictures' link: the router was there a moment ago."""

AGAIN_WITHIN_HZ = 50.0
"""A sample of a topic of at least this rate is not missed: the next one is there already."""


def comes_again(topic: Topic[Any]) -> bool:
    """Whether a sample of the topic is followed by another one within a moment."""
    return topic.rate_hz >= AGAIN_WITHIN_HZ


class Lanes:
    """One process' lanes. Safe to use from several threads.

    Args:
        session: for everything that has no lane of its own.
    """

    def __init__(self, session: Session) -> None:
        self.session = session
        self._apart = not session.endpoint.is_loopback
        self._pictures: Session | None = None
        self._opening = threading.Lock()
        self._datagrams: Datagrams | None = None
        if session.endpoint.datagrams:
            self._datagrams = Datagrams(session, session.endpoint.datagrams)
            self._datagrams.start()

    def stream(self, topic: Topic[Any]) -> Session:
        """The session on which a topic travels, unless it goes as datagrams.

        Raises:
            BusError: it has one of its own, which could not be opened.
        """
        if topic.qos is not QoS.PICTURE or not self._apart:
            return self.session
        with self._opening:
            if self._pictures is None:
                session = self.session
                self._pictures = open_session(session.endpoint.text, OPEN_S, credentials=session.credentials)
            return self._pictures

    def datagrams(self, topic: Topic[Any]) -> Datagrams | None:
        """How a topic travels as datagrams; None where it does not."""
        return self._datagrams if comes_again(topic) else None

    def close(self) -> None:
        """Leave the network."""
        if self._datagrams is not None:
            self._datagrams.close()
        if self._pictures is not None:
            self._pictures.close()
        self.session.close()
