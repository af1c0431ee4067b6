"""Writes down what comes on one side of a bad network, and when; on the far side it is a program of its own.

Usage: ear.py ENDPOINT FILE. It says "listening"; the end of its input makes it write the file, and ends it.
"""

import secrets
import select
import sys
from pathlib import Path

import msgpack

sys.path.insert(0, str(Path(__file__).parents[2]))

from protocol import topics
from services.bus.picture_queue import QueueReport
from services.bus.picture_stream import PictureStream
from services.bus.zenoh import Lanes, ZenohBus, open_session
from services.process.clock import SystemClock
from tests.cameras import HEAD_IMAGE, WRIST_IMAGE

ROBOT = "robot1"
OPEN_S = 60.0
NEAR = (topics.ROBOT_STATE, topics.MASTER_STATE)
PICTURES = (HEAD_IMAGE, WRIST_IMAGE)
FAR = (topics.WORLD_STATE, *PICTURES)
"""Of the robot only what is small: an ear is not to fill the link that it listens on."""

LOOK_S = 0.02


class Ear:
    """One side's; a context manager.

    It hears as the processes do, and before they judge: what is stale and what comes twice, too.

    Args:
        endpoint: of the router.
        listens: the topics.
    """

    def __init__(self, endpoint, listens):
        self.heard = []
        self._clock = SystemClock()
        self._bus = ZenohBus(Lanes(open_session(endpoint, OPEN_S)), ROBOT, f"ear-{secrets.token_hex(4)}", self._clock)
        heard = {topic: self._listen(topic) for topic in listens}
        self._queue = QueueReport(self._bus, *(PictureStream(heard[topic]) for topic in PICTURES if topic in heard))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._bus.close()

    def report(self):
        """Tell the cameras how late their pictures come, as who looks at them does."""
        self._queue.step(self._clock.now_ns())

    def _listen(self, topic):
        subscription = self._bus.subscribe(topic)
        receive = subscription.receive

        def hear(payload, schema, now_ns, key):
            self.heard.append((now_ns, topic.name, payload))
            receive(payload, schema, now_ns, key)

        subscription.receive = hear
        return subscription


def main(endpoint, file):
    """See the module."""
    with Ear(endpoint, FAR) as ear:
        print("listening", flush=True)
        while not select.select([sys.stdin], [], [], LOOK_S)[0]:
            ear.report()
        Path(file).write_bytes(msgpack.packb(ear.heard))


if __name__ == "__main__":
    main(*sys.argv[1:])
