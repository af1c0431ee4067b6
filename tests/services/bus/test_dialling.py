"""A session opens however late its router answers, and dials a cut link at the pace of the way there."""

import json
import socket

import pytest
import zenoh

from services.bus.reach import OPEN_LEAST_MS
from services.bus.zenoh import open_router, open_session
from services.bus.zenoh.dialling import Dialling, Opened
from services.process.endpoint import parse
from services.process.exceptions import RouterUnreachable
from tests.ports import free_port
from tests.services.bus.late import Late

pytestmark = pytest.mark.zenoh

WITHIN_S = 30.0


@pytest.fixture
def late():
    """A router that answers so late."""
    port = free_port()
    router = open_router(f"tcp/127.0.0.1:{port}")
    opened = []

    def make(late_s):
        opened.append(Late(port, late_s))
        return opened[-1]

    yield make
    for one in opened:
        one.close()
    router.close()


def test_a_router_that_answers_later_than_one_attempt_may_take_is_reached(late):
    way = late(OPEN_LEAST_MS / 1e3)
    session = open_session(way.endpoint, WITHIN_S)
    assert session.is_linked()
    session.close()


def test_who_never_answers_as_a_router_is_told_so_in_time(late):
    way = late(60.0)
    with pytest.raises(RouterUnreachable, match="does not answer as a router"):
        open_session(way.endpoint, 1.0)


class OneSession:
    """A session that counts for open until it is closed."""

    def __init__(self):
        self.closed = False
        self.info = self
        self.routers_zid = lambda: ["router"]
        self.declare_transport_events_listener = lambda _: None

    def close(self):
        """Leave."""
        self.closed = True


@pytest.mark.parametrize(
    ("answers", "kept"),
    [
        ([True], [OPEN_LEAST_MS]),
        ([False, False, True, True], [OPEN_LEAST_MS, 2 * OPEN_LEAST_MS, 4 * OPEN_LEAST_MS, OPEN_LEAST_MS]),
        ([False, True, False], [OPEN_LEAST_MS, 2 * OPEN_LEAST_MS, OPEN_LEAST_MS]),
    ],
    ids=["at once", "once it has begun", "late"],
)
def test_a_session_dials_at_the_quickest_pace_that_opens_it(monkeypatch, answers, kept):
    tried, sessions = [], []

    def answer(configuration):
        tried.append(json.loads(str(configuration))["transport"]["unicast"]["open_timeout"])
        if not answers[len(tried) - 1]:
            raise zenoh.ZError("Unable to connect. Timeout! at orchestrator.rs:388.")
        sessions.append(OneSession())
        return sessions[-1]

    monkeypatch.setattr("services.bus.zenoh.dialling.zenoh.open", answer)
    with socket.create_server(("127.0.0.1", 0)) as router:
        dialling = Dialling(parse(f"tcp/127.0.0.1:{router.getsockname()[1]}"))
        dialling.start()
        dialling.join(WITHIN_S)
    assert tried == kept
    assert dialling.opened == Opened(sessions[-1], kept[-1] if answers[-1] else tried[-2], "router")
    assert [one.closed for one in sessions] == [True] * (len(sessions) - 1) + [False]
