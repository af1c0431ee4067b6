"""A camera sends what comes through without a queue: less at once where one grows, all again where nobody queues."""

import pytest

from protocol.messages import PictureQueue
from protocol.topics import PICTURE_QUEUE
from services.bus.identity import new_publisher
from services.bus.memory import MemoryNetwork
from services.bus.outbox import Outbox
from services.camera.pacing import LEAST, LEAST_QUALITY, LONG_S, SHORT_S, Pacing
from services.process.clock import ManualClock

RATE_HZ = 15.0
QUALITY = 80
OTHER_MACHINE = 1 << 50


class Paced:
    """A camera, and who looks at its pictures."""

    def __init__(self):
        self.clock = ManualClock()
        self.network = MemoryNetwork(self.clock)
        self.pacing = Pacing(self.network.bus("camera"), RATE_HZ, QUALITY)
        self._lookers = {}

    def tell(self, late_s, name="station", away=True):
        identity = new_publisher() ^ (OTHER_MACHINE if away else 0)
        outbox = self._lookers.setdefault(name, Outbox(identity, self.network.robot, name))
        payload = outbox.pack(PICTURE_QUEUE, PictureQueue(late=late_s), self.clock.now_ns())
        self.network.deliver(PICTURE_QUEUE, payload)

    def run(self, seconds, late_s=None, **whose):
        """How many pictures were sent."""
        sent = 0
        for _ in range(round(seconds * RATE_HZ)):
            if late_s is not None:
                self.tell(late_s, **whose)
            self.clock.advance(1.0 / RATE_HZ)
            sent += self.pacing.due(self.clock.now_ns())
        return sent


def turns(paced, steps):
    """Whose pictures are sent, step by step."""
    taken = []
    for _ in range(steps):
        paced.clock.advance(0.5 / RATE_HZ)
        taken.append("".join(paced.pacing.turns(paced.clock.now_ns(), "hw")))
    return taken


@pytest.fixture
def paced():
    """With nobody who looks."""
    return Paced()


def test_where_nobody_looks_all_that_is_configured_is_sent(paced):
    assert paced.run(4.0) == round(4.0 * RATE_HZ)
    assert paced.pacing.quality == QUALITY


def test_who_looks_on_the_same_machine_without_a_queue_changes_nothing(paced):
    assert paced.run(4.0, 0.0, away=False) == round(4.0 * RATE_HZ)
    assert paced.pacing.share == 1.0


def test_for_who_begins_to_look_elsewhere_it_begins_with_the_least_and_soon_sends_all(paced):
    paced.run(1.0)
    paced.run(0.5, 0.0)
    assert paced.pacing.share < 0.2
    paced.run(4.0, 0.0)
    assert paced.pacing.share == 1.0


def test_a_queue_makes_it_send_less_and_worse_pictures_but_never_none(paced):
    paced.run(6.0, 0.0)
    before = paced.pacing.share
    paced.run(1.0, LONG_S + 0.01)
    assert paced.pacing.share < before
    assert paced.pacing.quality < QUALITY
    sent = paced.run(10.0, LONG_S + 0.01)
    assert paced.pacing.share == LEAST
    assert paced.pacing.quality == LEAST_QUALITY
    assert sent > 10.0


def test_on_one_machine_all_cameras_send_at_once(paced):
    assert turns(paced, 6) == ["hw", "", "hw", "", "hw", ""]


def test_on_a_link_each_camera_has_its_turn(paced):
    paced.run(6.0, 0.0)
    paced.tell(0.0)
    assert "".join(turns(paced, 9)).lstrip("w").startswith("hwhwhwh")


def test_between_long_and_short_it_sends_a_little_less(paced):
    paced.run(6.0, 0.0)
    paced.run(2.0, (LONG_S + SHORT_S) / 2.0)
    assert 0.5 < paced.pacing.share < 1.0


def test_the_worst_of_those_who_look_counts_until_it_has_gone(paced):
    paced.run(6.0, 0.0)
    for _ in range(round(2.0 * RATE_HZ)):
        paced.tell(LONG_S + 0.01, name="viewer")
        paced.run(1.0 / RATE_HZ, 0.0)
    low = paced.pacing.share
    assert low < 0.5
    paced.run(30.0, 0.0)
    assert paced.pacing.share > low
