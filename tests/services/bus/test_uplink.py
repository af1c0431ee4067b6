"""A router finds the other one that it joins, however long the way there is or has become."""

import pytest

from services.bus.zenoh import open_router, open_session, watch
from services.bus.zenoh.dialling import Opened
from services.bus.zenoh.router import Uplink
from services.process.endpoint import parse
from tests.ports import free_port
from tests.services.bus.late import LATE_S, Late
from tests.system.harness import eventually

pytestmark = [pytest.mark.zenoh, pytest.mark.usefixtures("soon")]

WITHIN_S = 60.0


@pytest.fixture
def opened():
    """What is closed after the test."""
    everything = []

    def one(something):
        everything.append(something)
        return something

    yield one
    for something in reversed(everything):
        something.close()


@pytest.fixture
def far(opened):
    """The other router's port."""
    port = free_port()
    opened(open_router(f"tcp/127.0.0.1:{port}"))
    return port


def hears(near, far, opened):
    """What passes at the near router comes from the far one."""
    ear, mouth = (opened(open_session(f"tcp/127.0.0.1:{port}", WITHIN_S)) for port in (near, far))
    heard = []
    watch(ear, "said", heard.append)

    def said():
        mouth.use(lambda current: current.session.put("said", b"x"))
        return heard

    return lambda: heard.clear() or eventually(said, WITHIN_S, "the far one is heard")


def test_a_router_that_was_silent_at_the_start_is_joined_over_a_long_way(far, opened):
    between, near = free_port(), free_port()
    router = opened(open_router(f"tcp/127.0.0.1:{near}", f"tcp/127.0.0.1:{between}"))
    opened(open_router(f"tcp/127.0.0.1:{free_port()}", f"tcp/127.0.0.1:{near}"))
    eventually(router.joined, WITHIN_S, "a third router joins, which is not the one that is missed")
    hears_far = hears(near, far, opened)
    opened(Late(far, LATE_S, at=between))
    hears_far()


def test_a_router_is_joined_again_when_the_way_has_become_longer(far, opened):
    way, near = opened(Late(far, 0.0)), free_port()
    opened(open_router(f"tcp/127.0.0.1:{near}", way.endpoint))
    hears_far = hears(near, far, opened)
    hears_far()
    way.late_s = LATE_S
    way.cut()
    hears_far()


class One:
    """Stands in for a router and for a session that tried the way to the other one."""

    pace_ms = 150

    def __init__(self, joined):
        self.info = self
        self.slower = []
        self.open_again = self.slower.append
        self.joined = self.routers_zid = lambda: joined
        self.close = lambda: None


@pytest.mark.parametrize(
    ("joined", "pace_ms", "slower"),
    [([], 600, [600]), (["third"], 600, [600]), (["third", "other"], 600, []), ([], 150, [])],
    ids=["missing", "another one is there", "there", "about to be there"],
)
def test_a_router_is_opened_again_only_where_it_misses_the_other_one_and_dials_too_quickly(joined, pace_ms, slower):
    router = One(joined)
    uplink = Uplink(router, parse("tcp/127.0.0.1:7447"))
    restored = uplink.take(Opened(One(["other"]), pace_ms, "other"))
    assert router.slower == slower
    assert uplink.is_linked() is restored is ("other" in joined)
