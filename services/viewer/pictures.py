"""The cameras' pictures, as JPEG files whatever they come as: a recording is to open everywhere, from any time on."""

from __future__ import annotations

from collections.abc import Iterable

import rerun as rr

from protocol.messages import Coding
from protocol.topics import CAMERA_IMAGE
from services.bus.bus import Bus
from services.bus.picture_queue import QueueReport
from services.bus.picture_stream import Group, PictureStream
from services.video.decoder import Decoder
from services.viewer import entities
from services.viewer.run import Run


class Pictures:
    """Of all cameras.

    Args:
        bus: from which they come, and on which the cameras are told how late.
        run: where they are drawn.
        names: of the cameras.
    """

    def __init__(self, bus: Bus, run: Run, names: Iterable[str]) -> None:
        self._run = run
        self._cameras = {name: _Camera(PictureStream(bus.subscribe(CAMERA_IMAGE.of(name)))) for name in names}
        self._queue = QueueReport(bus, *(camera.stream for camera in self._cameras.values()))

    @property
    def undecodable(self) -> int:
        """How many were no use so far."""
        return sum(camera.decoder.undecodable for camera in self._cameras.values())

    def draw(self, now_ns: int) -> None:
        """Draw what is new."""
        decoders = [camera.decoder for camera in self._cameras.values()]
        able, waits = all(one.is_able for one in decoders), any(one.waits for one in decoders)
        self._queue.step(now_ns, jpeg_only=not able, waits=waits)
        for name, camera in self._cameras.items():
            data = camera.take()
            if data is not None:
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
