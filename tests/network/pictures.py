"""Sends both cameras' pictures without drawing any: one that makes as many bytes as a scene does.

Usage: pictures.py ENDPOINT. It ends when it is killed.
"""

import functools
import sys
import threading
from pathlib import Path

import cv2
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))

from protocol import topics
from protocol.messages import CameraImage, Pose
from services.bus.zenoh import connect
from services.camera.coding import jpeg
from services.camera.pacing import Pacing
from services.process.clock import SystemClock

ROBOT = "robot1"
WIDTH, HEIGHT, QUALITY = 320, 240, 80
RATE_HZ = topics.HEAD_IMAGE.rate_hz
NOWHERE = Pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))
CAMERAS = (("head", topics.HEAD_IMAGE), ("wrist", topics.WRIST_IMAGE))


def scene():
    """Fine enough for 15 kB, RGB."""
    rough = np.random.default_rng(1).integers(0, 255, (HEIGHT // 6, WIDTH // 6, 3), dtype=np.uint8)
    return cv2.resize(rough, (WIDTH, HEIGHT), interpolation=cv2.INTER_LINEAR)


def main(endpoint):
    """See the module."""
    clock = SystemClock()
    bus = connect(endpoint, ROBOT, "camera", clock)
    pacing = Pacing(bus, RATE_HZ, QUALITY)
    encoded = functools.cache(functools.partial(jpeg, scene()))
    due, never = clock.now_ns(), threading.Event()
    while True:
        if pacing.due(clock.now_ns()):
            for name, topic in CAMERAS:
                bus.publish(topic, picture(name, encoded(pacing.quality), clock.now_ns()))
        due += round(1e9 / RATE_HZ)
        clock.sleep_until(due, never)


def picture(name, data, now_ns):
    """As a camera sends it."""
    return CameraImage(
        camera=name,
        width=WIDTH,
        height=HEIGHT,
        data=data,
        intrinsics=(1.0, 1.0, 0.0, 0.0),
        pose=NOWHERE,
        captured_ns=now_ns,
    )


if __name__ == "__main__":
    main(*sys.argv[1:])
