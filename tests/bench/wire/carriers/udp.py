"""A pair of UDP sockets, the floor of everything: nothing is between them, nothing comes again."""

import contextlib
import socket
import threading

MOST_BYTES = 65_536


@contextlib.contextmanager
def sending(settings, kind):
    """Sends messages of a kind."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as link:
        link.connect(("127.0.0.1", settings["ports"][kind == "picture"]))
        yield link.send


@contextlib.contextmanager
def receiving(settings, notes):
    """Hands what comes to the notes."""
    for port, hear in zip(settings["ports"], (notes.hear, notes.see), strict=False):
        link = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        link.bind(("127.0.0.1", port))
        threading.Thread(target=_read, args=(link, hear), daemon=True).start()
    yield


def _read(link, hear):
    while True:
        hear(link.recv(MOST_BYTES))
