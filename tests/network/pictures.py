"""Sends both cameras' pictures without drawing any: of a view that makes as many bytes as a scene does, and moves.

Usage: pictures.py ENDPOINT CODING. It ends when it is killed.
"""

import sys
import threading
from pathlib import Path

import cv2
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))

from protocol.messages import CameraImage, Coding, Pose
from services.bus.zenoh import connect
from services.camera.coding import coder
from services.camera.pacing import Pacing
from services.camera.wishes import Wishes
from services.process.clock import SystemClock
from services.process.config import CameraSection
from tests.cameras import HEAD_IMAGE, WRIST_IMAGE

ROBOT = "robot1"
WIDTH, HEIGHT, QUALITY = 320, 240, 80
RATE_HZ = HEAD_IMAGE.rate_hz
NOWHERE = Pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))
CAMERAS = (("head", HEAD_IMAGE), ("wrist", WRIST_IMAGE))


SPEED = 30.0
"""Of the view [pixels/s]."""


def scene():
    """Fine enough for 15 kB, RGB."""
    rough = np.random.default_rng(1).integers(0, 255, (HEIGHT // 6, WIDTH // 6, 3), dtype=np.uint8)
    return cv2.resize(rough, (WIDTH, HEIGHT), interpolation=cv2.INTER_LINEAR)


def main(endpoint, coding):
    """See the module."""
    clock = SystemClock()
    bus = connect(endpoint, ROBOT, "camera", clock)
    pacing, wishes = Pacing(bus, RATE_HZ, QUALITY), Wishes(bus)
    section = CameraSection(width=WIDTH, height=HEIGHT, quality=QUALITY, rate_hz=RATE_HZ, codec=Coding(coding))
    coders = {name: coder(section) for name, _ in CAMERAS}
    view = scene()
    due, never = clock.now_ns(), threading.Event()
    while True:
        now_ns = clock.now_ns()
        for name, topic in pacing.turns(now_ns, CAMERAS):
            seen = np.roll(view, round(SPEED * now_ns / 1e9), axis=1)
            bus.publish(
                topic, picture(name, coders[name].encode(seen, pacing.quality, now_ns, wishes.at(now_ns)), now_ns)
            )
        due += round(1e9 / RATE_HZ / len(CAMERAS))
        clock.sleep_until(due, never)


def picture(name, coded, now_ns):
    """As a camera sends it."""
    return CameraImage(
        camera=name,
        width=WIDTH,
        height=HEIGHT,
        data=coded.data,
        intrinsics=(1.0, 1.0, 0.0, 0.0),
        pose=NOWHERE,
        captured_ns=now_ns,
        coding=coded.coding,
        after_key=coded.after_key,
    )


if __name__ == "__main__":
    main(*sys.argv[1:])
