"""Whatever passes on the network, for tools that look at it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import zenoh

from services.bus.zenoh.encoding import announced
from services.bus.zenoh.session import Session
from services.bus.zenoh.transport import reason
from services.process.exceptions import BusError


@dataclass(frozen=True)
class Passing:
    """Something that passes on the network, as it stands in the packet."""

    key: str
    payload: bytes
    schema: str


def watch(session: Session, key_expression: str, callback: Callable[[Passing], None]) -> None:
    """Hand whatever passes on a key expression to the callback, foreign and newer senders' messages included.

    Raises:
        BusError: this is no key expression.
    """
    try:
        expression = zenoh.KeyExpr(key_expression)
    except zenoh.ZError as error:
        raise BusError(f"{key_expression!r} is no key expression: {reason(error)}") from None

    def hand_on(sample: zenoh.Sample) -> None:
        callback(Passing(str(sample.key_expr), sample.payload.to_bytes(), announced(sample.encoding)))

    session.declare(lambda current: current.declare_subscriber(expression, hand_on))
