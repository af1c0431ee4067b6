"""What the station hears of the others."""

from __future__ import annotations

from typing import TypeVar

from protocol import messages, topics
from protocol.messages import Message
from services.bus.bus import Bus
from services.bus.predictions import Predictions
from services.bus.subscription import Received, Subscription
from services.station.page.view import Picture

M = TypeVar("M", bound=Message)


HEARD_S = 0.3
"""Age at which the robot's state is not shown as its present one any more, on a busy machine too."""


class Ears:
    """What the station subscribes to."""

    def __init__(self, bus: Bus) -> None:
        self.robot = bus.subscribe(topics.ROBOT_STATE)
        self.authority = bus.subscribe(topics.AUTHORITY_STATE)
        self.safety = bus.subscribe(topics.SAFETY_STATE)
        self.scene = bus.subscribe(topics.SCENE_STATE)
        self.model = bus.subscribe(topics.MODEL_STATE)
        self.seen = bus.subscribe(topics.OBJECT_POSE)
        self.results = bus.subscribe(topics.EPISODE_RESULT)
        self.verdict = bus.subscribe(topics.VERDICT)
        self.recording = bus.subscribe(topics.RECORDING)
        self.master = bus.subscribe(topics.MASTER_STATE)
        self.execution = bus.subscribe(topics.EXECUTION)
        self.predictions = Predictions(bus)
        self.head = bus.subscribe(topics.HEAD_IMAGE)
        self.wrist = bus.subscribe(topics.WRIST_IMAGE)


def young(received: Received[M] | None, now_ns: int) -> M | None:
    """The message, where it came within `HEARD_S`."""
    return received.message if received is not None and received.age_s(now_ns) <= HEARD_S else None


def message(received: Received[M] | None) -> M | None:
    """The message, however old."""
    return received.message if received is not None else None


def came_s(received: Received[M] | None) -> float:
    """When it came, by the receiver's clock [s]; 0 where it has not."""
    return received.received_ns / 1e9 if received is not None else 0.0


def picture(camera: Subscription[messages.CameraImage], now_ns: int) -> Picture | None:
    """A camera's newest picture."""
    received = camera.latest()
    return Picture(received.message.data, received.age_s(now_ns)) if received is not None else None
