"""ZeroMQ over TCP: publishers connect to one who subscribes; nothing is between them."""

import contextlib
import threading

import zmq

KINDS = {"command": b"c", "picture": b"p"}


@contextlib.contextmanager
def sending(settings, kind):
    """Sends messages of a kind."""
    link = zmq.Context.instance().socket(zmq.PUB)
    link.connect(f"tcp://127.0.0.1:{settings['ports'][0]}")
    yield lambda payload: link.send_multipart((KINDS[kind], payload))


@contextlib.contextmanager
def receiving(settings, notes):
    """Hands what comes to the notes."""
    link = zmq.Context.instance().socket(zmq.SUB)
    link.bind(f"tcp://127.0.0.1:{settings['ports'][0]}")
    link.subscribe(b"")
    threading.Thread(target=_read, args=(link, notes), daemon=True).start()
    yield


def _read(link, notes):
    hear = {KINDS["command"]: notes.hear, KINDS["picture"]: notes.see}
    while True:
        kind, payload = link.recv_multipart()
        hear[kind](payload)
