"""A real camera: its pictures come on a thread of their own, whatever becomes of the device."""

from __future__ import annotations

import logging
import threading
from typing import NamedTuple

import cv2
import numpy as np

from services.bus.arrays import Floats
from services.camera.capture import Frames, Open, Shot, open_device
from services.camera.exceptions import CameraUnusable
from services.camera.optics import Optics, pinhole
from services.camera.places import Joints, Place
from services.camera.seen import Seen
from services.process.cameras import RealCamera
from services.process.clock import Clock

log = logging.getLogger(__name__)

AGAIN_S = 1.0
"""A device that is not there is looked for again after so long."""

CLOSE_S = 0.5
"""A thread that waits for a picture may wait longer; it holds nothing up."""


class _Came(NamedTuple):
    shot: Shot
    at_ns: int
    joints: Joints


class DeviceCamera:
    """See `Source`; safe to use from one thread beside its own.

    A picture is as old as it is since it came here: what it took the device before is not known.

    Args:
        camera: as it is configured.
        place: where it is.
        clock: for the times at which pictures come.
        size: of the pictures that are sent, width and height [pixel].
        optics: as they were calibrated; None for what the configuration says.
        opens: opens the device.
    """

    def __init__(
        self,
        camera: RealCamera,
        place: Place,
        clock: Clock,
        *,
        size: tuple[int, int],
        optics: Optics | None = None,
        opens: Open = open_device,
    ) -> None:
        self._camera, self._place, self._clock, self._size = camera, place, clock, size
        self._optics = None if optics is None else optics.of_size(*size)
        self._opens = opens
        self._came: _Came | None = None
        self._seen_ns = 0
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name=f"camera {camera.name}", daemon=True)
        self._thread.start()

    def look(self, now_ns: int) -> Seen | None:
        """See `Source.look`; nothing is seen either of when nobody knew where the camera was."""
        del now_ns
        came = self._came
        if came is None or came.at_ns == self._seen_ns:
            return None
        self._seen_ns = came.at_ns
        height, width, _ = came.shot.image.shape
        optics = self._optics or pinhole(self._camera.fovy, width, height).of_size(*self._size)
        image = np.asarray(cv2.resize(came.shot.image, self._size, interpolation=cv2.INTER_AREA), np.uint8)
        depth = came.shot.depth
        return Seen(
            image=optics.straightened(image),
            intrinsics=optics.matrix,
            pose=self._place.pose(came.joints),
            captured_ns=came.at_ns,
            depth=None if depth is None else lambda: _known(optics.straightened_depth(_resized(depth, self._size))),
        )

    def close(self) -> None:
        """Stop; the device is given back by its thread."""
        self._stop.set()
        self._thread.join(CLOSE_S)

    def _run(self) -> None:
        told = ""
        while not self._stop.is_set():
            try:
                frames = self._opens(self._camera, *self._size)
            except CameraUnusable as error:
                if str(error) != told:
                    log.warning("camera %s: %s; it is looked for again and again", self._camera.name, error)
                told = str(error)
                self._stop.wait(AGAIN_S)
                continue
            told = ""
            log.info("camera %s gives pictures", self._camera.name)
            self._film(frames)
            if not self._stop.is_set():
                log.warning("camera %s gives no pictures any more; it is looked for again", self._camera.name)
                self._stop.wait(AGAIN_S)

    def _film(self, frames: Frames) -> None:
        """Keep the newest picture until none comes any more."""
        try:
            while not self._stop.is_set():
                shot = frames.read()
                if shot is None:
                    return
                at_ns = self._clock.now_ns()
                joints = self._place.joints(at_ns)
                if joints is not None:
                    self._came = _Came(shot, at_ns, joints)
                self._stop.wait(frames.period_s)
        finally:
            frames.close()


def _resized(depth: Floats, size: tuple[int, int]) -> Floats:
    return np.asarray(cv2.resize(depth, size, interpolation=cv2.INTER_NEAREST), np.float64)


def _known(depth: Floats) -> Floats:
    """What is not known is nowhere near."""
    return np.where(depth > 0.0, depth, np.inf)
