"""What comes again within a moment comes as datagrams, and over the stream wherever these do not come through."""

import json
import threading

import pytest
import zenoh

from services.bus.zenoh import open_session
from services.bus.zenoh.datagrams import Datagrams
from tests.ports import free_port
from tests.services.bus.relay import Relay
from tests.system.harness import eventually

pytestmark = pytest.mark.zenoh

KEY = "moment"
PERIOD_S = 0.01
WITHIN_S = 20.0


@pytest.fixture
def port():
    """Of a router that takes streams and datagrams; somebody publishes on it all the time."""
    number = free_port()
    listens = [f"{protocol}/127.0.0.1:{number}" for protocol in ("tcp", "udp")]
    config = {"mode": "router", "listen": {"endpoints": listens}, "scouting": {"multicast": {"enabled": False}}}
    with zenoh.open(zenoh.Config.from_json5(json.dumps(config))) as router:
        end = threading.Event()

        def publish():
            while not end.wait(PERIOD_S):
                router.put(KEY, b"")

        publishing = threading.Thread(target=publish)
        publishing.start()
        yield number
        end.set()
        publishing.join()


class Hearing:
    """Declares, and tells apart over what its samples come.

    Args:
        session: whose stream it is.
        datagrams: beside it.
        lost: so many declarations of datagrams never reach the router.
    """

    def __init__(self, session, datagrams, lost=0):
        self._lost = lost
        self.stream = self.datagram = 0
        self._session = session
        datagrams.subscribe(self._declare, lambda sample: None)

    def _declare(self, session, hear):
        over_stream = session is self._session.current

        def count(sample):
            if over_stream:
                self.stream += 1
            else:
                self.datagram += 1
            hear(sample)

        if not over_stream and self._lost:
            self._lost -= 1
            return session.declare_subscriber("nothing", count)
        return session.declare_subscriber(KEY, count)

    def hears(self, over):
        """Wait until something comes over it from now on."""
        before = getattr(self, over)
        eventually(lambda: getattr(self, over) > before, WITHIN_S, f"something comes: {over}")

    def hears_only_datagrams(self):
        """Wait until nothing comes twice any more."""

        def only():
            before = self.stream
            self.hears("datagram")
            return self.stream == before

        eventually(only, WITHIN_S, "the stream falls silent")


@pytest.fixture
def hearing(port):
    """Over a relay; gives both, once it hears datagrams."""
    session = open_session(f"tcp/127.0.0.1:{port}", WITHIN_S)
    relay = Relay(port)
    datagrams = Datagrams(session, relay.endpoint)
    one = Hearing(session, datagrams)
    datagrams.start()
    yield one, relay
    datagrams.close()
    session.close()
    relay.close()


def test_what_comes_as_a_datagram_does_not_come_over_the_stream_too(hearing):
    one, _ = hearing
    one.hears("datagram")
    one.hears_only_datagrams()


def test_where_no_datagram_comes_any_more_the_stream_serves_until_they_do(hearing):
    one, relay = hearing
    one.hears("datagram")
    one.hears_only_datagrams()
    relay.lost = True
    one.hears("stream")
    relay.lost = False
    one.hears("datagram")
    one.hears_only_datagrams()


def test_where_nobody_takes_datagrams_the_stream_serves(port):
    session = open_session(f"tcp/127.0.0.1:{port}", WITHIN_S)
    datagrams = Datagrams(session, f"udp/127.0.0.1:{free_port()}")
    one = Hearing(session, datagrams)
    datagrams.start()
    one.hears("stream")
    assert not datagrams.put(lambda session: session.put(KEY, b""))
    datagrams.close()
    session.close()


def test_a_declaration_that_was_lost_is_repeated_until_something_comes(port):
    session = open_session(f"tcp/127.0.0.1:{port}", WITHIN_S)
    datagrams = Datagrams(session, f"udp/127.0.0.1:{port}")
    one = Hearing(session, datagrams, lost=2)
    datagrams.start()
    one.hears("datagram")
    one.hears_only_datagrams()
    datagrams.close()
    session.close()
