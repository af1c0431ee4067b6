"""Writes down what comes on one side of a bad network, and when; on the far side it is a program of its own.

Usage: ear.py ENDPOINT FILE. It says "listening"; the end of its input makes it write the file, and ends it.
"""

import secrets
import sys
from pathlib import Path

import msgpack

sys.path.insert(0, str(Path(__file__).parents[2]))

from protocol import topics
from services.bus.zenoh import Lanes, ZenohBus, open_session
from services.process.clock import SystemClock

ROBOT = "robot1"
OPEN_S = 60.0
NEAR = (topics.ROBOT_STATE, topics.MASTER_STATE)
FAR = (topics.ROBOT_STATE, topics.HEAD_IMAGE, topics.WRIST_IMAGE)


class Ear:
    """One side's; a context manager.

    It hears as the processes do, and before they judge: what is stale and what comes twice, too.

    Args:
        endpoint: of the router.
        listens: the topics.
    """

    def __init__(self, endpoint, listens):
        self.heard = []
        self._bus = ZenohBus(Lanes(open_session(endpoint, OPEN_S)), ROBOT, f"ear-{secrets.token_hex(4)}", SystemClock())
        for topic in listens:
            self._listen(topic)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._bus.close()

    def _listen(self, topic):
        def hear(payload, schema, now_ns, key):
            self.heard.append((now_ns, topic.name, payload))

        self._bus.subscribe(topic).receive = hear


def main(endpoint, file):
    """See the module."""
    with Ear(endpoint, FAR) as ear:
        print("listening", flush=True)
        sys.stdin.read()
        Path(file).write_bytes(msgpack.packb(ear.heard))


if __name__ == "__main__":
    main(*sys.argv[1:])
