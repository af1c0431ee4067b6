"""From H.264 to pictures again: right ones, or none."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from services.bus.picture_stream import Group
from services.video.library import is_installed, library

MOST_PIXELS = 1920 * 1088
"""As large as a camera's pictures may be, in whole blocks; what claims to be larger would only take memory."""

JPEG_QUANTISER = 3  # from 2, the best, to 31


class Decoder:
    """Of one camera; used by one thread.

    Attributes:
        waits: what came last was none of its pictures; the next key picture is waited for.
        undecodable: how many pictures were no use so far.
    """

    def __init__(self) -> None:
        self.waits = False
        self.undecodable = 0
        self._av: Any = library() if is_installed() else None
        self._context: Any = None
        self._group: Group | None = None

    @property
    def is_able(self) -> bool:
        """Whether anything can be decoded here."""
        return self._av is not None

    def grey(self, group: Group) -> NDArray[np.uint8] | None:
        """The brightness of a group's last picture, shape (height, width); None where it is no picture."""
        frame = self._decode(group)
        return None if frame is None else np.asarray(frame.to_ndarray(format="gray"), dtype=np.uint8)

    def rgb(self, group: Group) -> NDArray[np.uint8] | None:
        """A group's last picture, shape (height, width, 3); None where it is no picture."""
        frame = self._decode(group)
        return None if frame is None else np.asarray(frame.to_ndarray(format="rgb24"), dtype=np.uint8)

    def jpeg(self, group: Group) -> bytes | None:
        """A group's last picture as a JPEG file; None where it is no picture."""
        frame = self._decode(group)
        if frame is None:
            return None
        coder = self._av.CodecContext.create("mjpeg", "w")
        coder.width, coder.height, coder.pix_fmt, coder.time_base = frame.width, frame.height, "yuvj420p", 1
        coder.options = {"qmin": str(JPEG_QUANTISER), "qmax": str(JPEG_QUANTISER)}
        (packet,) = coder.encode(frame.reformat(format="yuvj420p"))
        return bytes(packet)

    def _decode(self, group: Group) -> Any:
        """The last of what has not been decoded; None where there is nothing new, or what is there cannot be used."""
        if self._av is None or not group.pictures:
            return None
        begun = self._group is not None and self._group.number == group.number
        if begun and self.waits:
            return None
        if not begun:
            self._context = self._open()
        pictures, self._group = group.after(self._group), group
        frame = None
        try:
            for picture in pictures:
                (frame,) = self._context.decode(self._av.Packet(picture))
        except (self._av.FFmpegError, ValueError):
            frame = None
        self.waits = bool(pictures) and frame is None
        self.undecodable += self.waits
        return frame

    def _open(self) -> Any:
        context = self._av.CodecContext.create("h264", "r")
        context.thread_count = 1
        # What is damaged is refused; FFmpeg would else paint over it what was there before.
        context.options = {"err_detect": "explode", "max_pixels": str(MOST_PIXELS), "flags": "low_delay"}
        return context
