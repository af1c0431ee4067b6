"""A session opens however late its router answers, and dials a cut link at the pace of the way there."""

import contextlib
import json
import select
import socket
import threading
import time

import pytest
import zenoh

from services.bus.reach import OPEN_LEAST_MS
from services.bus.zenoh import close_session, open_router, open_session
from services.process.exceptions import RouterUnreachable
from tests.ports import free_port

pytestmark = pytest.mark.zenoh

WITHIN_S = 30.0


class Late:
    """Stands before a router and passes on what both sides say, each time so much later.

    Args:
        port: of the router.
        late_s: of what the router says [s].
    """

    def __init__(self, port, late_s):
        self.late_s = late_s
        self.opened = 0
        self._port = port
        self._server = socket.create_server(("127.0.0.1", 0))
        self.endpoint = f"tcp/127.0.0.1:{self._server.getsockname()[1]}"
        threading.Thread(target=self._accept, daemon=True).start()

    def close(self):
        """Accept no more."""
        self._server.close()

    def _accept(self):
        with contextlib.suppress(OSError):
            while True:
                near, _ = self._server.accept()
                self.opened += 1
                threading.Thread(target=self._pass_on, args=(near,), daemon=True).start()

    def _pass_on(self, near):
        with contextlib.suppress(OSError), near, socket.create_connection(("127.0.0.1", self._port)) as far:
            while True:
                for side in select.select([near, far], [], [])[0]:
                    said = side.recv(65536)
                    if not said:
                        return
                    if side is far:
                        time.sleep(self.late_s)
                    (near if side is far else far).sendall(said)


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
    close_session(router)


def test_a_router_that_answers_later_than_one_attempt_may_take_is_reached(late):
    way = late(OPEN_LEAST_MS / 1e3)
    session = open_session(way.endpoint, WITHIN_S)
    assert list(session.info.routers_zid())
    close_session(session)


def test_who_never_answers_as_a_router_is_told_so_in_time(late):
    way = late(60.0)
    with pytest.raises(RouterUnreachable, match="does not answer as a router"):
        open_session(way.endpoint, 1.0)


class Opened:
    """A session that counts for open until it is closed."""

    def __init__(self):
        self.closed = False

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
        sessions.append(Opened())
        return sessions[-1]

    monkeypatch.setattr("services.bus.zenoh.sessions.zenoh.open", answer)
    with socket.create_server(("127.0.0.1", 0)) as router:
        session = open_session(f"tcp/127.0.0.1:{router.getsockname()[1]}", WITHIN_S)
    assert tried == kept
    assert session is sessions[-1]
    assert [one.closed for one in sessions] == [True] * (len(sessions) - 1) + [False]
