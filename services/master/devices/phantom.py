"""A Phantom Omni or Touch at the master's own computer, by `pyOpenHaptics` and the vendor's driver.

Tried against a stand-in for the vendor's interface only.
"""

from __future__ import annotations

import importlib
import math
from collections.abc import Callable, Sequence
from typing import Any, Protocol, cast

import numpy as np
from numpy.typing import NDArray

from lfd.motion.rotations import exp_map, log_map, matrix_from_quaternion
from protocol.messages import Controller, Vector3
from services.bus.arrays import vector3
from services.master.devices.device import ZERO
from services.master.devices.lever import turned
from services.process.exceptions import DeviceMissing, RoomMissing
from sim.person.stylus import StylusState

KIND = "phantom"
MODULE = "pyOpenHaptics.hd"
CALLBACKS = "pyOpenHaptics.hd_callback"
MILLIMETRE = 1e-3

CUT_OFF_HZ = 30.0
"""Of the velocity, which is a difference of positions [Hz]."""

BUTTONS = 2

TO_BASE = np.array([[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
"""The device counts right, up, and towards the hand."""

Transform = Sequence[Sequence[float]]
"""Four columns of four [mm]: the last one is where the tip is."""


class Vendor(Protocol):
    """What is used of the vendor's interface."""

    def init_device(self) -> int | None:
        """Open the default device; None where there is none."""
        ...

    def enable_force(self) -> None: ...  # noqa: D102  # as the vendor names them

    def serve(self, body: Callable[[], None]) -> None:
        """Call the body in every frame, a thousand times a second, on the vendor's own thread."""
        ...

    def get_transform(self) -> Transform: ...  # noqa: D102

    def get_buttons(self) -> int: ...  # noqa: D102

    def set_force(self, force: Sequence[float]) -> None: ...  # noqa: D102

    def stop(self, device: int) -> None:
        """Serve no more, and close the device."""
        ...


def vendor() -> Vendor:
    """The modules.

    Raises:
        RoomMissing: they, or the driver that they need, are not installed.
    """
    try:
        return cast(Vendor, _OpenHaptics(importlib.import_module(MODULE), importlib.import_module(CALLBACKS)))
    except (ImportError, OSError):
        raise RoomMissing(KIND, MODULE.partition(".")[0]) from None


class _OpenHaptics:
    """The two modules as one `Vendor`."""

    def __init__(self, hd: Any, callbacks: Any) -> None:
        self._hd = hd
        self._callbacks = callbacks
        self._callback: Any = None
        self.init_device = hd.init_device
        self.enable_force = hd.enable_force
        self.get_transform = hd.get_transform
        self.get_buttons = hd.get_buttons
        self.set_force = hd.set_force

    def serve(self, body: Callable[[], None]) -> None:
        self._callback = self._callbacks.hd_callback(body)  # kept: the driver's thread calls it as long as it serves
        self._hd.start_scheduler()
        self._callbacks.hdAsyncSheduler(self._callback)

    def stop(self, device: int) -> None:
        self._hd.stop_scheduler()
        self._hd.close_device(device)


class PhantomStylus:
    """See `HapticDevice`. Its neutral pose is set by whoever takes it up.

    Attributes:
        yaw: by which the operator's axes are to be turned about the base's z axis [rad], see `OperatorInput.yaw`; from
            the next frame on they are. Not to be changed while a hand counts.

    Args:
        module: the vendor's.

    Raises:
        DeviceMissing: there is no device, or it cannot be opened.
    """

    def __init__(self, module: Vendor) -> None:
        self._module = module
        number = module.init_device()
        if number is None:
            raise DeviceMissing(KIND, "plug it in, switch it on, and start the vendor's setup once")
        self._number = number
        self.yaw = self._turned = 0.0
        self._neutral = ZERO
        self._before: Vector3 | None = None
        self._velocity = ZERO
        self._transform: Transform = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.0,) * 4)
        self._buttons = 0
        self._upright: NDArray[np.float64] = np.eye(3)
        self.state = StylusState()

    def serve(self, body: Callable[[], None]) -> None:
        """Call the body a thousand times a second."""
        self._module.enable_force()
        self._module.serve(body)

    def exchange(self, force: Vector3, dt: float) -> StylusState:
        """See `HapticDevice`; called within a frame."""
        self._turn_axes()
        fx, fy, fz = turned(force, -self._turned)
        self._module.set_force((-fy, fz, -fx))
        self._transform, self._buttons = self._module.get_transform(), self._module.get_buttons()
        x, y, z = (MILLIMETRE * self._transform[3][axis] for axis in range(3))
        place = turned((-z, -x, y), self._turned)
        before, self._before = self._before or place, place
        share = 1.0 - math.exp(-2.0 * math.pi * CUT_OFF_HZ * dt)
        vx, vy, vz = (
            v + share * ((now - then) / dt - v) for v, now, then in zip(self._velocity, place, before, strict=True)
        )
        self._velocity = (vx, vy, vz)
        nx, ny, nz = self._neutral
        self.state = StylusState((place[0] - nx, place[1] - ny, place[2] - nz), self._velocity)
        return self.state

    def take_up(self, displacement: Vector3) -> None:
        """Where it is now, the displacement from its neutral pose is this one [m], and it is turned by nothing."""
        (px, py, pz), (nx, ny, nz), (x, y, z) = self.state.position, self._neutral, displacement
        self._neutral = (nx + px - x, ny + py - y, nz + pz - z)
        self._upright = self._orientation()

    def rotation(self) -> Vector3:
        """By how much the handle was turned since it was taken up, rotation vector in base axes [rad]."""
        return vector3(log_map(_quaternion(self._orientation() @ self._upright.T)))

    def controller(self) -> Controller:
        """Its buttons."""
        return Controller(KIND, buttons=tuple(float(bool(self._buttons >> bit & 1)) for bit in range(BUTTONS)))

    def close(self) -> None:
        """Render nothing any more, and let go."""
        self._module.stop(self._number)

    def _turn_axes(self) -> None:
        """What is known in the axes before, in the new ones: a hand that stands still stands still in them."""
        by, self._turned = self.yaw - self._turned, self.yaw
        self._neutral, self._velocity = turned(self._neutral, by), turned(self._velocity, by)
        if self._before is not None:
            self._before = turned(self._before, by)

    def _orientation(self) -> NDArray[np.float64]:
        columns = np.array([[self._transform[column][row] for column in range(3)] for row in range(3)])
        to_base = matrix_from_quaternion(exp_map(np.array((0.0, 0.0, self._turned)))) @ TO_BASE
        in_base: NDArray[np.float64] = to_base @ columns @ TO_BASE.T
        return in_base


def _quaternion(matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """Of a rotation matrix, scalar first (Shepperd, 1978)."""
    diagonal = np.diag(matrix)
    squares = np.array([matrix.trace(), *(2.0 * diagonal - matrix.trace())]) + 1.0
    largest = int(np.argmax(squares))
    vector = np.array([matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]])
    if largest == 0:
        quaternion = np.array([squares[0], *vector])
    else:
        axis = largest - 1
        sums = matrix[axis] + matrix[:, axis]
        sums[axis] = squares[largest]
        quaternion = np.array([vector[axis], *sums])
    unit: NDArray[np.float64] = quaternion / np.linalg.norm(quaternion)
    return unit
