"""A participant of a study without a browser: reads what their page is shown, does what it asks for."""

import contextlib
import threading

import msgspec
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from tests.system.harness import eventually


class Participant:
    """At the study's page from a thread of its own, until the end of the context; the page comes back by itself.

    Args:
        port: of the study's pages.
        number: theirs.

    Attributes:
        stage: what the page shows; None before it has said.
        part: name of the part that they are at.
        refused: what did not count, and why.
    """

    def __init__(self, port, number):
        self.stage = None
        self.part = ""
        self.refused = []
        self._address = f"127.0.0.1:{port}"
        self._number = number
        self._link = None
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._sit, daemon=True)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._over.set()
        self._thread.join(5.0)

    def sees(self, stage, within_s, what=""):
        """Wait for a stage; what it shows."""
        return eventually(
            lambda: (shown := self.stage) and shown["stage"] == stage and shown,
            within_s,
            lambda: f"{stage} {what}; it shows {self.stage}, refused {self.refused}",
        )

    def does(self, act, **said):
        """Do something, once."""
        self._link.send(msgspec.json.encode({"id": 1, "act": {"act": act, **said}}).decode())

    def _sit(self):
        while not self._over.is_set():
            with contextlib.suppress(OSError, ConnectionClosed), self._opened() as link:
                self._link = link
                self._read(link)
            self.stage = None
            self._over.wait(0.1)

    def _opened(self):
        return connect(f"ws://{self._address}/link/{self._number}", origin=f"http://{self._address}", max_size=None)

    def _read(self, link):
        while not self._over.is_set():
            with contextlib.suppress(TimeoutError):
                said = msgspec.json.decode(link.recv(timeout=0.1))
                if "stage" in said:
                    self.stage, self.part = said["stage"], (said["part"] or {}).get("name", "")
                elif said["refused"]:
                    self.refused.append(said["refused"])
