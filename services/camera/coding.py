"""How a camera's pictures are coded: JPEG, or H.264 where all who look can show it."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, NamedTuple, Protocol

import cv2
import numpy as np

from protocol.messages import MOST_AFTER_KEY, Coding
from services.bus.arrays import Colours
from services.camera.wishes import Wish
from services.process.config import CameraSection
from services.process.exceptions import UnusableSetting
from services.video.library import library

KEY_EVERY_NS = 1_000_000_000
"""For so long at most one who has lost a picture sees nothing new."""

KEY_APART_NS = 300_000_000
"""A key picture is under way for a while, during which it is still asked for."""

BITS_A_PIXEL = 0.45
"""Of a picture of the best quality. The least of what makes the simulated cameras' as good as the same quality's JPEG,
the first one and those of a fast motion too."""

LEAST_BIT_RATE = 8_000
"""The encoder counts in thousands."""

BURST_S = 0.25
"""In so much of the bit rate a key picture has to fit."""

LESS = 0.8
"""Of the bit rate: where it falls further there is a key picture at once, else the new one counts from the next on."""

SMPTE_170M, LIMITED = 6, 1
"""As H.264 numbers what the colours mean (ITU-T H.264, annex E), and FFmpeg that brightness goes from 16 to 235."""

FINEST = 18
"""Quantiser below which nobody sees a difference: what stands still is not sent finer and finer."""


class Coded(NamedTuple):
    """A picture as it is sent; see `CameraImage`."""

    data: bytes
    coding: Coding = Coding.JPEG
    after_key: int = 0


class Coder(Protocol):
    """Codes one camera's pictures."""

    def encode(self, image: Colours, quality: int, now_ns: int, wish: Wish) -> Coded:
        """The picture, RGB of shape (height, width, 3).

        Args:
            image: the picture.
            quality: 10 to 100, as of a JPEG file; how many bytes it takes follows from it.
            now_ns: the time.
            wish: of those who look.
        """
        ...


class JpegCoder:
    """See `Coder`; every picture stands for itself."""

    def encode(self, image: Colours, quality: int, now_ns: int, wish: Wish) -> Coded:
        """See `Coder.encode`."""
        del now_ns, wish
        return Coded(jpeg(image, quality))


class H264Coder:
    """See `Coder`; JPEG while somebody looks who can show nothing else.

    A picture needs the one before it, so that nothing is coded ahead and none waits for a later one. There is a key
    picture every second, and where somebody has lost one.

    Args:
        section: size and rate of the pictures.

    Raises:
        RoomMissing: the library is not installed.
        UnusableSetting: H.264 knows no pictures of this size.
    """

    def __init__(self, section: CameraSection) -> None:
        for name in ("width", "height"):
            if getattr(section, name) % 2:
                raise UnusableSetting(f"[camera] {name}", "H.264 takes even numbers of pixels")
        self._av = library()
        self._section = section
        self._context: Any = None
        self._count = 0
        self._after_key = 0
        self._key_ns = 0
        self._opened_at = 0

    def encode(self, image: Colours, quality: int, now_ns: int, wish: Wish) -> Coded:
        """See `Coder.encode`."""
        if wish.jpeg_only:
            self._context = None
            return Coded(jpeg(image, quality))
        bit_rate = self._bit_rate(quality)
        key = self._is_key(now_ns, wish) or bit_rate < LESS * self._opened_at
        if self._context is None or (key and bit_rate != self._opened_at):
            self._context, self._opened_at = self._open(bit_rate), bit_rate
        frame = self._av.VideoFrame.from_ndarray(np.ascontiguousarray(image), format="rgb24")
        frame = frame.reformat(format="yuv420p", dst_colorspace="ITU601")
        kinds = self._av.video.frame.PictureType
        frame.pts, frame.pict_type = self._count, kinds.I if key else kinds.NONE
        (packet,) = self._context.encode(frame)
        self._count += 1
        if key:
            self._key_ns = now_ns
        self._after_key = 0 if key else self._after_key + 1
        return Coded(bytes(packet), Coding.H264, self._after_key)

    def _is_key(self, now_ns: int, wish: Wish) -> bool:
        if self._context is None or self._after_key == MOST_AFTER_KEY:
            return True
        since_ns = now_ns - self._key_ns
        return since_ns >= KEY_EVERY_NS or (wish.key and since_ns >= KEY_APART_NS)

    def _bit_rate(self, quality: int) -> int:
        """At the full rate of pictures [bit/s]; where they are fewer, each may be as large, and it is less."""
        section = self._section
        wanted = BITS_A_PIXEL * quality / 100 * section.width * section.height * section.rate_hz
        return max(LEAST_BIT_RATE, round(wanted))

    def _open(self, bit_rate: int) -> Any:
        section = self._section
        context = self._av.CodecContext.create("libx264", "w")
        context.width, context.height, context.pix_fmt = section.width, section.height, "yuv420p"
        context.framerate = Fraction(section.rate_hz).limit_denominator(1000)
        context.time_base = 1 / context.framerate
        context.bit_rate, context.thread_count, context.gop_size = bit_rate, 1, MOST_AFTER_KEY + 1
        # Said in the stream: browsers take another matrix for granted.
        context.colorspace = context.color_primaries = context.color_trc = SMPTE_170M
        context.color_range = LIMITED
        context.options = {
            "preset": "superfast",
            "tune": "zerolatency",
            "profile": "baseline",
            "maxrate": str(bit_rate),
            "bufsize": str(round(BURST_S * bit_rate)),
            "qmin": str(FINEST),
            "forced-idr": "1",
            "sc_threshold": "0",
        }
        return context


def jpeg(image: Colours, quality: int) -> bytes:
    """The picture, RGB of shape (height, width, 3), as a JPEG file of this quality, 10 to 100."""
    bgr = cv2.cvtColor(np.ascontiguousarray(image), cv2.COLOR_RGB2BGR)
    return cv2.imencode(".jpg", bgr, [cv2.IMWRITE_JPEG_QUALITY, quality])[1].tobytes()


def coder(section: CameraSection) -> Coder:
    """For one camera, as it is configured.

    Raises:
        RoomMissing: the library that the codec needs is not installed.
        UnusableSetting: it cannot code pictures of this size.
    """
    return H264Coder(section) if section.codec is Coding.H264 else JpegCoder()
