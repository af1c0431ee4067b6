"""A way to a router on which datagrams can be lost."""

import contextlib
import select
import socket
import threading


class Relay:
    """Stands before a router's port for datagrams, for one client, and passes on what both sides say.

    Args:
        port: of the router.

    Attributes:
        endpoint: where it listens.
        lost: nothing passes while it is true.
    """

    def __init__(self, port):
        self.lost = False
        self._client = None
        self._near = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._near.bind(("127.0.0.1", 0))
        self._port = port
        self._far = self._router()
        self.endpoint = f"udp/127.0.0.1:{self._near.getsockname()[1]}"
        self._end = threading.Event()
        self._passing = threading.Thread(target=self._pass_on)
        self._passing.start()

    def _router(self):
        far = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        far.connect(("127.0.0.1", self._port))
        return far

    def close(self):
        """Pass nothing on any more."""
        self._end.set()
        self._passing.join()
        self._near.close()
        self._far.close()

    def _pass_on(self):
        while not self._end.is_set():
            for side in select.select([self._near, self._far], [], [], 0.02)[0]:
                with contextlib.suppress(OSError):
                    self._pass(side)

    def _pass(self, side):
        if side is self._far:
            packet = side.recv(65536)
            if self._client is not None and not self.lost:
                self._near.sendto(packet, self._client)
            return
        packet, client = side.recvfrom(65536)
        if client != self._client:  # it has dialled anew: the router is to see that
            self._far.close()
            self._client, self._far = client, self._router()
        if not self.lost:
            self._far.send(packet)
