"""What the receiving end of a topic keeps, and what it says about it."""

import threading

import pytest

from protocol import topics
from protocol.codec import encode
from protocol.messages import MasterState
from services.bus.clocks import Clocks
from services.bus.identity import new_publisher
from services.bus.subscription import Subscription
from services.bus.tally import Drops
from services.process.clock import ManualClock

TOPIC = topics.MASTER_STATE
OWN = new_publisher()
SAME_MACHINE, OTHER_MACHINE = OWN ^ 1, OWN ^ (1 << 50)


class Ear:
    """A subscription at a clock that stands still between two samples."""

    def __init__(self):
        self.clock = ManualClock()
        self.call = threading.Event()
        self.subscription = Subscription(TOPIC, "robot1", OWN, Clocks(OWN), self.call)
        self._sequence = 0

    def hear(self, publisher=SAME_MACHINE, late_s=0.0, **changed):
        self._sequence += 1
        stamp_ns = self.clock.now_ns() - round(late_s * 1e9)
        place = {"robot": "robot1", "topic": TOPIC.name, "process": "master-ann", "publisher": publisher}
        message = MasterState(**({"sequence": self._sequence, "stamp_ns": stamp_ns} | place | changed))
        self.subscription.receive(encode(TOPIC, message), "", self.clock.now_ns())

    def figures(self, after_s=0.0):
        self.clock.advance(after_s)
        return self.subscription.figures(self.clock.now_ns())


@pytest.fixture
def ear():
    return Ear()


def test_at_first_nothing_was_thrown_away_and_nothing_is_to_be_said(ear):
    assert set(vars(Drops()).values()) == {0}
    figures = ear.figures()
    assert (figures.topic, figures.rate_hz, figures.age, figures.latency, figures.drops) == (TOPIC.name, 0.0, -1, -1, 0)
    assert ear.subscription.take_fault() == ""
    assert ear.subscription.latest() is None
    assert ear.subscription.fresh(ear.clock.now_ns()) is None


def test_the_first_figures_have_no_interval_to_tell_a_rate_by(ear):
    ear.hear()
    assert ear.figures(1.0).rate_hz == 0.0
    ear.hear()
    assert ear.figures(0.5).rate_hz == 2.0
    ear.hear()
    assert ear.figures(0.0).rate_hz == 0.0, "nor has an interval that is none"


def test_the_age_is_since_it_came_and_the_latency_is_its_time_on_the_way(ear):
    ear.hear(late_s=0.02)
    figures = ear.figures(3.0)
    assert (figures.age, figures.latency) == (3.0, 0.02)
    assert ear.subscription.latest().age_s(ear.clock.now_ns()) == 3.0


def test_of_another_machine_no_latency_is_told(ear):
    ear.hear(OTHER_MACHINE, late_s=0.02)
    figures = ear.figures(3.0)
    assert (figures.age, figures.latency) == (3.0, -1.0)


def test_a_message_is_fresh_up_to_the_topics_time_to_become_stale(ear):
    ear.hear()
    ear.clock.advance(TOPIC.stale_after_ns / 1e9)
    now_ns = ear.clock.now_ns()
    assert ear.subscription.fresh(now_ns) is not None
    assert ear.subscription.fresh(now_ns + 1) is None


def test_what_came_is_judged_by_the_topics_time_to_become_stale(ear):
    ear.hear(late_s=TOPIC.stale_after_ns / 1e9 + 1e-9)
    assert ear.subscription.latest() is None
    assert ear.figures().stale == 1
    assert ear.subscription.take_fault() == "", "lateness is no fault of the sender's"


def test_of_what_comes_between_two_steps_the_newest_are_kept(ear):
    for _ in range(TOPIC.kept + 3):
        ear.hear()
    kept = [received.message.sequence for received in ear.subscription.take()]
    assert kept == list(range(4, TOPIC.kept + 4))
    assert ear.subscription.take() == []
    assert ear.subscription.latest().message.sequence == TOPIC.kept + 3


def test_what_nobody_could_take_for_newer_ones_is_counted(ear):
    ear.subscription.take()
    for _ in range(TOPIC.kept + 3):
        ear.hear()
    assert ear.figures().crowded == 3
    assert ear.subscription.take_fault() == "", "so it is with whoever is slower than the sender"


def test_whoever_looks_at_the_newest_only_misses_nothing(ear):
    for _ in range(TOPIC.kept + 3):
        ear.hear()
    assert ear.figures().drops == 0


def test_a_number_that_nobody_can_have_come_to_is_named_once(ear):
    ear.hear(sequence=2**53)
    assert ear.figures().implausible == 1
    assert ear.subscription.take_fault() == f"implausible on {TOPIC.name}: 'master-ann' counts to {2**53}"
    assert ear.subscription.take_fault() == ""


def test_nobody_can_change_what_came_and_when(ear):
    ear.hear()
    with pytest.raises(AttributeError):
        ear.subscription.latest().received_ns = 0


def test_a_message_that_counts_calls_and_one_that_does_not_lets_wait(ear):
    ear.hear()
    assert ear.call.is_set()
    ear.call.clear()
    ear.hear(late_s=10.0)
    ear.hear(robot="robot2")
    assert not ear.call.is_set()
