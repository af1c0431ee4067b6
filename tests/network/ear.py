"""Writes down what passes on one side of a bad network, and when; on the far side it is a program of its own.

Usage: ear.py ENDPOINT FILE KEY... It says "listening"; the end of its input makes it write the file, and ends it.
"""

import select
import sys
from pathlib import Path

import msgpack

sys.path.insert(0, str(Path(__file__).parents[2]))

from protocol import topics
from services.bus.zenoh import ZenohBus, open_session, watch
from services.process.clock import SystemClock

ROBOT = "robot1"
OPEN_S = 60.0
LOOK_S = 0.02
"""Less than between two pictures."""

PICTURES = (topics.HEAD_IMAGE, topics.WRIST_IMAGE)


class Ear:
    """One side's; a context manager.

    Args:
        endpoint: of the router.
        names: of the topics to hear, as they pass; stale ones and repeated ones, too.
    """

    def __init__(self, endpoint, names):
        self.heard = []
        self._clock = SystemClock()
        self._session = open_session(endpoint, OPEN_S)
        for name in names:
            watch(self._session, f"retouch/{topics.VERSION}/{ROBOT}/{name}/*", self._hear)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._session.close()

    def _hear(self, passing):
        self.heard.append((self._clock.now_ns(), "/".join(passing.key.split("/")[3:5]), passing.payload))


class Viewer:
    """Looks at the pictures as the processes do, and notes how old each was; a context manager.

    Args:
        endpoint: of the router.
    """

    def __init__(self, endpoint):
        self.seen = []
        self._bus = ZenohBus(open_session(endpoint, OPEN_S), ROBOT, "viewer-far", SystemClock())
        self._pictures = [self._bus.subscribe(topic) for topic in PICTURES]

    def look(self):
        """Note what has come since."""
        for pictures in self._pictures:
            for received in pictures.take():
                image = received.message
                self.seen.append((received.received_ns, image.camera, image.stamp_ns, len(image.data)))

    def close(self):
        """Leave the network."""
        self._bus.close()


def main(endpoint, file, *names):
    """See the module."""
    viewer = Viewer(endpoint)
    with Ear(endpoint, names) as ear:
        print("listening", flush=True)
        while not select.select([sys.stdin], [], [], LOOK_S)[0]:
            viewer.look()
        Path(file).write_bytes(msgpack.packb([ear.heard, viewer.seen]))
    viewer.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
