"""What a transport hands to the receiver of another key, as one was seen to after a cut, is dropped and counted."""

import msgspec
import pytest

from protocol import topics
from protocol.codec import encode
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from tests.protocol.filled import filled

by_topic = pytest.mark.parametrize("topic", topics.TOPICS, ids=lambda t: t.name)


def publisher(topic):
    """A process that publishes the topic."""
    return "cli-1" if topic.publisher == "any" else topic.publisher


def sound(topic, robot, process=None):
    """A message of a topic as its publisher, or that process, sends it for a robot, encoded."""
    place = {"robot": robot, "topic": topic.name, "process": process or publisher(topic), "sequence": 1, "stamp_ns": 0}
    return encode(topic, msgspec.structs.replace(filled(topic.type), **place))


class Receiver:
    """Whoever hears a topic of robot1, through a transport that names its key whatever comes."""

    def __init__(self, topic):
        self._clock = ManualClock()
        self._bus = MemoryNetwork(self._clock).bus()
        self._key = topic.key("robot1", publisher(topic))
        self.subscription = self._bus.subscribe(topic)

    def gets(self, payload, schema):
        """Hand it over."""
        self.subscription.receive(payload, schema, self._clock.now_ns(), self._key)

    def refused(self):
        """How much was dropped, whatever the cause, and that it was named; nothing of it counts."""
        assert self.subscription.take() == []
        assert self.subscription.latest() is None
        assert self._bus.faults()
        drops = self.subscription.drops
        return drops.misplaced + drops.wrong_version


@by_topic
def test_a_sample_under_its_own_key_counts(topic):
    receiver = Receiver(topic)
    receiver.gets(sound(topic, "robot1"), topic.schema)
    assert len(receiver.subscription.take()) == 1


@by_topic
def test_a_sample_of_another_robot_under_this_ones_key_is_dropped_and_counted(topic):
    receiver = Receiver(topic)
    receiver.gets(sound(topic, "robot2"), topic.schema)
    assert receiver.refused() == receiver.subscription.drops.misplaced == 1


@by_topic
def test_a_sample_of_any_other_topic_under_this_ones_key_is_dropped_and_counted(topic):
    receiver = Receiver(topic)
    others = [other for other in topics.TOPICS if other is not topic]
    for other in others:
        receiver.gets(sound(other, "robot1"), other.schema)
    alike = [other for other in others if other.schema == topic.schema]
    assert receiver.refused() == len(others)
    assert receiver.subscription.drops.misplaced == len(alike), "those of its own type no schema tells apart"


@by_topic
def test_a_sample_of_another_process_under_this_ones_key_is_dropped_and_counted(topic):
    receiver = Receiver(topic)
    receiver.gets(sound(topic, "robot1", f"{publisher(topic)}-2"), topic.schema)
    assert receiver.refused() == receiver.subscription.drops.misplaced == 1
