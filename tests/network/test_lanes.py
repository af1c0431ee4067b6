"""Over a network a lost sample delays none after it, and the queue that pictures make goes away."""

import sys
import threading
from pathlib import Path

import msgpack
import numpy as np
import pytest

from protocol import topics
from protocol.codec import decode
from protocol.messages import Coding, Pose, WorldState
from services.bus.arrays import to_wire
from services.bus.zenoh import connect
from services.process.clock import SystemClock
from tests.cameras import HEAD_IMAGE
from tests.network.ear import ROBOT
from tests.network.link import AHEAD_S, Impossible, Link
from tests.network.sites import running
from tests.ports import free_port
from tests.system.harness import START_S, Command, reachable

pytestmark = [pytest.mark.system, pytest.mark.zenoh]

HERE = Path(__file__).parent
LISTENED_S = 6.0
SETTLED_S = 12.0
NEWEST_S = 4.0


@pytest.fixture
def far(tmp_path):
    """A link to a far machine with a router on this one; starts an ear there, and says what it has heard by now."""
    try:
        entered = Link().__enter__()
    except Impossible as reason:
        pytest.skip(str(reason))
    port, file = free_port(), tmp_path / "far.ear"
    here = f"tcp/127.0.0.1:{port}"

    def hear(seconds):
        program = [*entered.there, sys.executable, HERE / "ear.py", f"tcp/{entered.near}:{port}", file]
        with running(program) as ear:
            assert ear.stdout.readline() == "listening\n"
            threading.Event().wait(seconds)
            ear.stdin.close()
            ear.wait(START_S)
        return msgpack.unpackb(file.read_bytes())

    with Command("router", "--insecure", "--listen", f"tcp/0.0.0.0:{port}", folder=tmp_path) as router:
        router.until(lambda: reachable(here), START_S, "the router listens")
        yield entered, here, hear
    entered.__exit__()


@pytest.fixture
def world(far):
    """The robot's site says where everything is, all the time."""
    bus, end = connect(far[1], ROBOT, "robot", SystemClock()), threading.Event()
    state = WorldState(time=0.0, qpos=to_wire([0.0]), object_pose=Pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)))

    def talk():
        while not end.wait(1.0 / topics.WORLD_STATE.rate_hz):
            bus.publish(topics.WORLD_STATE, state)

    talking = threading.Thread(target=talk)
    talking.start()
    yield
    end.set()
    talking.join()
    bus.close()


def test_a_sample_that_is_lost_is_not_waited_for(far, world):
    link, _, hear = far
    link.shape(delay_s=0.03, loss=0.05)
    heard = hear(LISTENED_S)
    numbers = [decode(topics.WORLD_STATE, raw).sequence for _, name, raw in heard if name == topics.WORLD_STATE.name]
    newest = numbers[len(numbers) // 2 :]
    missing = set(range(newest[0], newest[-1])) - set(newest)
    assert 0 < len(missing) < 0.3 * len(newest)


def test_the_queue_that_pictures_make_on_a_thin_link_goes_away(far):
    link, here, hear = far
    link.shape(delay_s=0.02, rate=1.5e6)
    with running([sys.executable, HERE / "pictures.py", here, Coding.JPEG.value]):
        heard = hear(SETTLED_S)
    came_ns = max(at for at, _, _ in heard)
    newest = [(at, decode(HEAD_IMAGE, raw)) for at, name, raw in heard if name == HEAD_IMAGE.name]
    ages = [(at - image.captured_ns) / 1e9 - AHEAD_S for at, image in newest if came_ns - at < NEWEST_S * 1e9]
    assert len(ages) > NEWEST_S
    assert np.median(ages) < 0.3
