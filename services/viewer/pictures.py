"""The cameras' pictures, as JPEG files whatever they come as: a recording is to open everywhere, from any time on."""

from __future__ import annotations

import rerun as rr

from protocol.messages import Coding
from protocol.topics import HEAD_IMAGE, WRIST_IMAGE
from services.bus.bus import Bus
from services.bus.picture_queue import QueueReport
from services.bus.picture_stream import Group, PictureStream
from services.video.decoder import Decoder
from services.viewer import entities
from services.viewer.run import Run


class Pictures:
    """Of both cameras.

    Args:
        bus: from which they come, and on which the cameras are told how late.
        run: where they are drawn.
    """

    def __init__(self, bus: Bus, run: Run) -> None:
        self._run = run
        self._head, self._wrist = (_Camera(PictureStream(bus.subscribe(topic))) for topic in (HEAD_IMAGE, WRIST_IMAGE))
        self._queue = QueueReport(bus, self._head.stream, self._wrist.stream)

    @property
    def undecodable(self) -> int:
        """How many were no use so far."""
        return self._head.decoder.undecodable + self._wrist.decoder.undecodable

    def draw(self, now_ns: int) -> None:
        """Draw what is new."""
        decoders = self._head.decoder, self._wrist.decoder
        able, waits = all(one.is_able for one in decoders), any(one.waits for one in decoders)
        self._queue.step(now_ns, jpeg_only=not able, waits=waits)
        for camera in (self._head, self._wrist):
            self._draw(camera)

    def _draw(self, camera: _Camera) -> None:
        data = camera.take()
        if data is not None:
            name = "head" if camera is self._head else "wrist"
            self._run.log(f"{entities.CAMERAS}/{name}", rr.EncodedImage(contents=data, media_type="image/jpeg"))


class _Camera:
    """One camera's stream, and what has been drawn of it."""

    def __init__(self, stream: PictureStream) -> None:
        self.stream = stream
        self.decoder = Decoder()
        self._drawn: Group | None = None

    def take(self) -> bytes | None:
        """The newest picture, where it has not been taken."""
        self.stream.latest()
        group, before = self.stream.group, self._drawn
        if group is before or not group.pictures:
            return None
        self._drawn = group
        return group.pictures[-1] if group.coding is Coding.JPEG else self.decoder.jpeg(group)
