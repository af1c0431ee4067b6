"""A link that Zenoh does not find again by itself, because the way has become another, is opened anew."""

import gc
import threading
from functools import partial

import pytest
import zenoh

from protocol import queries, topics
from protocol.messages import ModelState
from services.bus.zenoh import open_router, open_session
from services.process.exceptions import NameTaken
from tests.ports import free_port
from tests.services.bus.late import LATE_S, Late
from tests.system.harness import eventually

pytestmark = [pytest.mark.zenoh, pytest.mark.usefixtures("soon")]

WITHIN_S = 20.0


@pytest.fixture
def way(router):
    """To the router: short at first."""
    one = Late(router, 0.0)
    yield one
    one.close()


@pytest.fixture
def bus(join):
    """A function that opens the bus of another process."""
    return partial(join, "robot1")


def becomes_longer(way):
    """A cut, and the way is another one."""
    way.late_s = LATE_S
    way.cut()


def state(version):
    return ModelState(kind="adaptive", version=version, demonstrations=1, updates=0, scene="s")


def hears(sender, subscription, version):
    """Publish until it is heard; the message."""

    def heard():
        sender.publish(topics.MODEL_STATE, state(version))
        received = subscription.latest()
        return received is not None and received.message.version == version and received.message

    return eventually(heard, WITHIN_S, f"version {version} is heard")


def test_what_is_published_comes_again_and_its_numbers_go_on(way, bus):
    model, station = bus("model", way.endpoint), bus("station")
    subscription = station.subscribe(topics.MODEL_STATE)
    before = hears(model, subscription, 1)
    becomes_longer(way)
    after = hears(model, subscription, 2)
    assert after.publisher == before.publisher
    assert after.sequence > before.sequence


def test_who_only_listens_hears_again(way, bus):
    model, station = bus("model"), bus("station", way.endpoint)
    subscription = station.subscribe(topics.MODEL_STATE)
    hears(model, subscription, 1)
    becomes_longer(way)
    hears(model, subscription, 2)


def answered(asker, server, asked):
    """Ask until there is an answer, and let the server give it."""
    pending = []

    def got():
        if not pending or pending[0].poll() is not None:
            pending.insert(0, asker.ask(queries.UNDO, asked, timeout_s=2.0))
        for call in server.take():
            call.reply(queries.Learnt(state(7)))
        return any(isinstance(one.poll(), queries.Learnt) for one in pending)

    eventually(got, WITHIN_S, "it is answered")


@pytest.mark.parametrize("far", ["model", "station"], ids=["who is asked", "who asks"])
def test_questions_are_answered_again(way, bus, far):
    model, station = (bus(name, way.endpoint) if name == far else bus(name) for name in ("model", "station"))
    server = model.serve(queries.UNDO)
    answered(station, server, queries.Undo(request=1))
    becomes_longer(way)
    answered(station, server, queries.Undo(request=2))


def test_a_name_is_claimed_again(way, bus):
    model, station = bus("model", way.endpoint), bus("station")
    becomes_longer(way)
    hears(model, station.subscribe(topics.MODEL_STATE), 1)
    with pytest.raises(NameTaken):
        bus("model")


@pytest.fixture
def dialled(monkeypatch):
    """Sessions that were opened from now on; each only once it is let."""
    opened, tried, let = [], threading.Event(), threading.Event()
    really = zenoh.open

    def open_when_let(configuration):
        tried.set()
        assert let.wait(WITHIN_S)
        opened.append(really(configuration))
        return opened[-1]

    def let_open():
        let.set()
        return eventually(lambda: opened, WITHIN_S, "it opens")[0]

    def watch():
        monkeypatch.setattr("services.bus.zenoh.dialling.zenoh.open", open_when_let)
        return tried, let_open

    return watch


def test_a_link_that_comes_back_by_itself_serves_until_another_one_takes_its_place(way, dialled):
    """It may be deaf."""
    session = open_session(way.endpoint, WITHIN_S)
    first = session.current
    tried, let_open = dialled()
    becomes_longer(way)
    assert tried.wait(WITHIN_S)
    way.late_s = 0.0
    eventually(first.info.routers_zid, WITHIN_S, "it comes back by itself")
    assert session.current is first
    other = let_open()
    eventually(first.is_closed, WITHIN_S, "the first one is left")
    assert session.current is other
    assert session.is_linked()
    session.close()


def test_a_loss_is_noticed_that_is_over_before_anybody_looks(way, monkeypatch):
    monkeypatch.setattr("services.bus.zenoh.redialling.LOOK_S", 3600.0)
    session = open_session(way.endpoint, WITHIN_S)
    gc.collect()
    opened = way.opened
    assert session.is_linked()
    way.cut()
    eventually(lambda: way.opened > opened and session.current.info.routers_zid(), WITHIN_S, "it comes back by itself")
    assert not session.is_linked()
    session.close()


def test_after_every_loss_the_session_is_opened_anew(way):
    session = open_session(way.endpoint, WITHIN_S)
    for _ in range(5):
        before = session.current
        way.cut()
        eventually(before.is_closed, WITHIN_S, "it is left")
        assert session.is_linked()
    session.close()


def test_a_router_that_was_started_again_between_two_looks_is_noticed(monkeypatch):
    monkeypatch.setattr("services.bus.zenoh.redialling.LOOK_S", 3600.0)
    endpoint = f"tcp/127.0.0.1:{free_port()}"
    router = open_router(endpoint)
    session = open_session(endpoint, WITHIN_S)
    assert session.is_linked()
    router.close()
    router = open_router(endpoint)
    eventually(session.current.info.routers_zid, WITHIN_S, "it comes back by itself")
    assert not session.is_linked()
    session.close()
    router.close()


def test_a_session_that_opens_when_the_old_one_is_closed_is_dropped(way, dialled):
    session = open_session(way.endpoint, WITHIN_S)
    tried, let_open = dialled()
    becomes_longer(way)
    assert tried.wait(WITHIN_S)
    session.close()
    way.late_s = 0.0
    eventually(let_open().is_closed, WITHIN_S, "the new one is closed")
