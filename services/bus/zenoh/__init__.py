"""The bus over Zenoh; the only package that knows Zenoh."""

from services.bus.zenoh.bus import ZenohBus, connect
from services.bus.zenoh.encoding import ENCODING
from services.bus.zenoh.sessions import close_session, open_router, open_session
from services.bus.zenoh.watch import Passing, watch

__all__ = [
    "ENCODING",
    "Passing",
    "ZenohBus",
    "close_session",
    "connect",
    "open_router",
    "open_session",
    "watch",
]
