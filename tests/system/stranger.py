"""A program that is none of ours, on a real network."""

from collections import deque

import zenoh

from services.bus.zenoh import ENCODING, Passing, open_session, watch
from tests.system.harness import START_S, eventually


class Stranger:
    """A program that puts whatever bytes it likes on a network; a context manager.

    Args:
        endpoint: of the router.
    """

    def __init__(self, endpoint):
        self._session = open_session(endpoint, START_S)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._session.close()

    def put(self, key, payload, schema=""):
        """Publish; waits where the network is busy, so that nothing is lost."""
        encoding = zenoh.Encoding(ENCODING).with_schema(schema) if schema else zenoh.Encoding.ZENOH_BYTES
        self._session.current.put(key, payload, encoding=encoding, congestion_control=zenoh.CongestionControl.BLOCK)

    def get(self, key, payload, schema=""):
        """Ask; the payloads of all answers."""
        encoding = zenoh.Encoding(ENCODING).with_schema(schema)
        replies = self._session.current.get(key, payload=payload, encoding=encoding, timeout=5.0)
        return [reply.ok.payload.to_bytes() for reply in replies if reply.ok is not None]

    def listened(self, key):
        """Wait until somebody listens to a key, as far as the network knows: what is put before then is lost."""
        publisher = self._session.current.declare_publisher(key)
        eventually(lambda: publisher.matching_status.matching, START_S, f"somebody listens to {key}")
        publisher.undeclare()

    def answered(self, key):
        """Wait until somebody answers on a key, as far as the network knows."""
        querier = self._session.current.declare_querier(key)
        eventually(lambda: querier.matching_status.matching, START_S, f"somebody answers on {key}")
        querier.undeclare()

    def watch(self, key, callback):
        """Hand what passes on a key expression to the callback, on a thread of Zenoh's."""
        watch(self._session, key, callback)

    def listen(self, key, kept=1000):
        """What passes on a key expression from now on, the newest last."""
        heard: deque[Passing] = deque(maxlen=kept)
        self.watch(key, heard.append)
        return heard
