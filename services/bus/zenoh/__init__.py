"""The bus over Zenoh; the only package that knows Zenoh."""

from services.bus.zenoh.bus import ZenohBus, connect
from services.bus.zenoh.encoding import ENCODING
from services.bus.zenoh.lanes import Lanes
from services.bus.zenoh.router import Router, open_router, router_settings
from services.bus.zenoh.session import Session, open_session
from services.bus.zenoh.watch import Passing, watch

__all__ = [
    "ENCODING",
    "Lanes",
    "Passing",
    "Router",
    "Session",
    "ZenohBus",
    "connect",
    "open_router",
    "open_session",
    "router_settings",
    "watch",
]
