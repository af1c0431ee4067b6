"""Somebody at the operator's page without a browser: alive, in view, holding nothing, pressing as they are told."""

import contextlib
import secrets
import threading
import time

import msgspec
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from services.station.page.said import Held, Hello, Pressed

PERIOD_S = 0.02


class Somebody:
    """Says what the page's script says, from a thread of its own, until the end of the context.

    Args:
        host: that the page is served on.
        port: of the page.
        name: that they give.
        role: that they ask for.

    Attributes:
        shown: what the page shows them, by name.
        armed: they have the input.
    """

    def __init__(self, host, port, name="", role=""):
        self.shown = {}
        self.armed = False
        self._seat = f"seat-of-{name or 'somebody'}"
        self._load = f"load-{secrets.token_hex(8)}"
        self._name = name
        self._role = role
        self._address = f"{host}:{port}"
        self._over = threading.Event()
        self._presses = []
        self._said = 0
        self._thread = threading.Thread(target=self._sit, daemon=True)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self.leave()

    def leave(self):
        """Close the page."""
        self._over.set()
        self._thread.join(5.0)

    def press(self, action, argument=""):
        """Press a button, once."""
        self._presses.append((action, argument))

    def _sit(self):
        while not self._over.is_set():
            with contextlib.suppress(OSError, ConnectionClosed), self._opened() as link:
                self._say(link, Hello(self._seat, self._load, self._name, self._role))
                self._stay(link)
            self._over.wait(0.1)

    def _opened(self):
        """The page's link, once the page is there."""
        return connect(f"ws://{self._address}/link", origin=f"http://{self._address}", max_size=None)

    def _stay(self, link):
        pressed = 0
        while not self._over.is_set():
            self._say(
                link, Held(keys=(), visible=True, focused=True, controllers=(), drawn=(0, 0, 0, 0), **self._stamp())
            )
            while pressed < len(self._presses):
                pressed += 1
                action, argument = self._presses[pressed - 1]
                self._say(link, Pressed(number=pressed, action=action, argument=argument, **self._stamp()))
            self._read(link, time.monotonic() + PERIOD_S)

    def _stamp(self):
        self._said += 1
        return {"sequence": self._said, "stamp_ms": time.monotonic() * 1e3}

    @staticmethod
    def _say(link, message):
        link.send(msgspec.json.encode(message).decode())

    def _read(self, link, until):
        """Look at what the page is told."""
        while (left := until - time.monotonic()) > 0.0:
            try:
                frame = link.recv(timeout=left)
            except TimeoutError:
                return
            if isinstance(frame, str):
                news = msgspec.json.decode(frame)
                self.shown.update(news["values"])
                self.armed = news["armed"]
