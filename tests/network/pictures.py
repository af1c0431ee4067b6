"""Publishes both cameras' pictures without drawing any: noise that makes as many bytes as a scene does.

Usage: pictures.py ENDPOINT. It ends when it is killed.
"""

import sys
import threading
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))

from protocol import topics
from protocol.messages import CameraImage, Pose
from services.bus.zenoh import connect
from services.process.clock import SystemClock

ROBOT = "robot1"
BYTES = 15_000
NOWHERE = Pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))
CAMERAS = (("head", topics.HEAD_IMAGE), ("wrist", topics.WRIST_IMAGE))


def main(endpoint):
    """See the module."""
    clock = SystemClock()
    bus = connect(endpoint, ROBOT, "camera", clock)
    data = np.random.default_rng(1).bytes(BYTES)
    due, never = clock.now_ns(), threading.Event()
    while True:
        for name, topic in CAMERAS:
            image = CameraImage(
                camera=name,
                width=320,
                height=240,
                data=data,
                intrinsics=(1.0, 1.0, 0.0, 0.0),
                pose=NOWHERE,
                captured_ns=clock.now_ns(),
            )
            bus.publish(topic, image)
        due += round(1e9 / topics.HEAD_IMAGE.rate_hz)
        clock.sleep_until(due, never)


if __name__ == "__main__":
    main(*sys.argv[1:])
