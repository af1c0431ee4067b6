"""What a session keeps when Zenoh's session under it is exchanged for another one."""

import threading
import weakref

import pytest
import zenoh

from services.bus.zenoh.dialling import Opened
from services.bus.zenoh.session import Session
from services.process.endpoint import parse


class One:
    """A session of Zenoh's, as far as another one takes its place."""

    def __init__(self):
        self.declared = []
        self.closed = False

    def close(self):
        """Leave."""
        self.closed = True


class Publisher:
    """One of Zenoh's, as far as several threads use it: none may undeclare it while another one publishes."""

    def __init__(self):
        self.begun, self.end = threading.Event(), threading.Event()

    def put(self):
        """Publish; takes as long as the test wants."""
        self.begun.set()
        self.end.wait()

    def undeclare(self):
        """End it."""
        if self.begun.is_set() and not self.end.is_set():
            raise RuntimeError("Already borrowed")


@pytest.fixture
def opened():
    """Two of them."""
    return [Opened(One(), 150), Opened(One(), 300)]


@pytest.fixture
def session(opened):
    """Over the first."""
    return Session(parse("tcp/127.0.0.1:7447"), opened[0])


def declare(session, what):
    session.declare(lambda current: current.declared.append(what))


def test_what_was_declared_is_declared_again_and_the_old_session_is_left(session, opened):
    declare(session, "a")
    declare(session, "b")
    session.take(opened[1])
    assert session.current is opened[1].session
    assert session.pace_ms == 300
    assert session.current.declared == ["a", "b"]
    assert opened[0].session.closed


def test_what_is_declared_meanwhile_is_declared_once_on_each(session, opened):
    def meanwhile(current):
        current.declared.append("a")
        if current is not opened[0].session:
            declare(session, "b")

    session.declare(meanwhile)
    session.take(opened[1])
    declare(session, "c")
    assert opened[0].session.declared == ["a", "b"]
    assert opened[1].session.declared == ["a", "b", "c"]


def test_a_session_that_is_closed_meanwhile_leaves_both(session, opened):
    session.declare(lambda current: session.close() if current is not opened[0].session else None)
    session.take(opened[1])
    assert [one.session.closed for one in opened] == [True, True]


def test_a_session_that_is_lost_at_once_takes_no_place(session, opened):
    def lost(current):
        if current is not opened[0].session:
            raise zenoh.ZError("session closed")

    session.declare(lost)
    session.take(opened[1])
    assert session.current is opened[0].session
    assert [one.session.closed for one in opened] == [False, True]


def test_what_meets_the_exchange_is_done_with_the_new_session(session, opened):
    def act(current):
        if current is opened[0]:
            session.take(opened[1])
            raise zenoh.ZError("session closed")
        return current

    assert session.use(act) is opened[1]


def test_what_fails_without_an_exchange_fails(session):
    def act(_):
        raise zenoh.ZError("no such thing")

    with pytest.raises(zenoh.ZError, match="no such thing"):
        session.use(act)


def test_publishers_end_before_their_session_is_left_even_while_one_publishes(session, opened):
    idle, busy = Publisher(), Publisher()
    ends = weakref.ref(idle)
    opened[0].publishers.update(idle=idle, busy=busy)
    opened[0].session.close = lambda: left.append(ends())
    left = []
    publishing = threading.Thread(target=busy.put)
    publishing.start()
    busy.begun.wait()
    del idle
    assert session.take(opened[1])
    busy.end.set()
    publishing.join()
    assert left == [None]
