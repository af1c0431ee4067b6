"""Every call gets an answer: what cannot be done is refused with the reason."""

from __future__ import annotations

import logging
from collections.abc import Callable

from lfd.exceptions import LfdError
from protocol.queries import Refused
from services.bus.bus import Rep, Req
from services.bus.server import Server
from services.process.exceptions import ServiceError
from sim.exceptions import SimError

log = logging.getLogger(__name__)


def answer(server: Server[Req, Rep], reply: Callable[[Req], Rep | Refused]) -> None:
    """Answer what was asked since the last time.

    Args:
        server: of a query.
        reply: makes the answer; raises what every room raises for people.
    """
    for call in server.take():
        try:
            call.reply(reply(call.request))
        except (LfdError, ServiceError, SimError) as error:
            log.warning("refused: %s", error)
            call.reply(Refused(str(error)))
