"""A TCP cable that can be cut: what is on its way then stays there, and nobody at its ends is told."""

import contextlib
import socket
import threading


class Cable:
    """Carries every connection to a port of this machine.

    Args:
        port: where the station listens.
    """

    def __init__(self, port):
        self._station = ("127.0.0.1", port)
        self._whole = threading.Event()
        self._whole.set()
        self._ends = []
        self._carriers = []
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.url = f"http://127.0.0.1:{self._listener.getsockname()[1]}"
        self._accepting = threading.Thread(target=self._accept, daemon=True)
        self._accepting.start()

    def cut(self):
        """Carry nothing any more."""
        self._whole.clear()

    def mend(self, *, lost=False):
        """Carry again; `lost` where the connections that were cut are not taken up again."""
        if lost:
            self._close_ends()
        self._whole.set()

    def close(self):
        """End every connection, and let nobody connect any more."""
        # Closed alone it would go on listening, for the thread that waits there.
        self._listener.shutdown(socket.SHUT_RDWR)
        self._accepting.join()
        self._listener.close()
        self.mend(lost=True)
        for carrier in self._carriers:
            carrier.join()
        for end in self._ends:
            end.close()

    def _close_ends(self):
        for end in self._ends:
            with contextlib.suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)

    def _accept(self):
        with contextlib.suppress(OSError):
            while True:
                browser, _ = self._listener.accept()
                station = socket.create_connection(self._station)
                self._ends += [browser, station]
                for ends in ((browser, station), (station, browser)):
                    self._carriers.append(threading.Thread(target=self._carry, args=ends, daemon=True))
                    self._carriers[-1].start()

    def _carry(self, source, sink):
        with contextlib.suppress(OSError):
            while data := source.recv(65_536):
                self._whole.wait()
                sink.sendall(data)
        with contextlib.suppress(OSError):
            sink.shutdown(socket.SHUT_WR)
