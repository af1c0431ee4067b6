"""A way to a router on which everything takes its time."""

import contextlib
import select
import socket
import threading
import time

LATE_S = 0.2
"""So late nobody is through in the time that a link over loopback is given."""


class Late:
    """Stands before a router and passes on what both sides say, what the router says each time so much later.

    Args:
        port: of the router.
        late_s: of what the router says; it may change [s].
        at: the port to listen on; by default any.

    Attributes:
        endpoint: where it listens.
        opened: how many links were begun so far.
    """

    def __init__(self, port, late_s, at=0):
        self.late_s = late_s
        self.opened = 0
        self._port = port
        self._links = set()
        self._server = socket.create_server(("127.0.0.1", at))
        self.endpoint = f"tcp/127.0.0.1:{self._server.getsockname()[1]}"
        threading.Thread(target=self._accept, daemon=True).start()

    def cut(self):
        """End every link that there is."""
        for near in list(self._links):
            with contextlib.suppress(OSError):
                near.shutdown(socket.SHUT_RDWR)

    def close(self):
        """Accept no more, and end what there is."""
        self._server.shutdown(socket.SHUT_RDWR)
        self._server.close()
        self.cut()

    def _accept(self):
        with contextlib.suppress(OSError):
            while True:
                near, _ = self._server.accept()
                self.opened += 1
                threading.Thread(target=self._pass_on, args=(near,), daemon=True).start()

    def _pass_on(self, near):
        self._links.add(near)
        with contextlib.suppress(OSError), near, socket.create_connection(("127.0.0.1", self._port)) as far:
            while True:
                for side in select.select([near, far], [], [])[0]:
                    said = side.recv(65536)
                    if not said:
                        return
                    if side is far:
                        time.sleep(self.late_s)
                    (near if side is far else far).sendall(said)
        self._links.discard(near)
