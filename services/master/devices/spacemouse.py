"""A 3-D mouse at the master's own computer, by `pyspacemouse` and hidapi.

Tried against a stand-in for the vendor's interface only.
"""

from __future__ import annotations

import importlib
import threading
from collections.abc import Mapping, Sequence
from typing import Protocol, cast

from protocol.messages import Controller, OperatorInput
from services.master.devices.controllers import hand, named
from services.master.devices.hand import Hand
from services.master.devices.profiles import Profiles
from services.process.exceptions import RoomMissing

KIND = "spacemouse"
MODULE = "pyspacemouse"

PERIOD_S = 0.005
"""Between two looks for what the device has said [s]."""

AGAIN_S = 1.0
"""Between two looks for a device that is not there [s]."""

PACKETS_AT_MOST = 64
"""Read in one look."""


class State(Protocol):
    """What the vendor's module says of a device: `t` grows with every packet."""

    t: float
    x: float
    y: float
    z: float
    roll: float
    pitch: float
    yaw: float
    buttons: Sequence[int]


class Mouse(Protocol):
    """An open device."""

    @property
    def name(self) -> str:
        """Of the model."""
        ...

    def read(self) -> State:
        """The state after one packet, where there is one; does not wait."""
        ...

    def close(self) -> None:
        """Let go of it."""
        ...


class Vendor(Protocol):
    """What is used of the module `pyspacemouse`."""

    def open(self, *, axis_convention: str) -> Mouse:
        """The first device that is there; RuntimeError where none is."""
        ...

    def get_connected_devices(self) -> Sequence[str]:
        """Names of those that are there."""
        ...


def vendor() -> Vendor:
    """The module.

    Raises:
        RoomMissing: it, or the library that it needs, is not installed.
    """
    try:
        return cast(Vendor, importlib.import_module(MODULE))
    except (ImportError, OSError, AttributeError):
        raise RoomMissing(KIND, MODULE) from None


class SpaceMouse:
    """Reads the device on a thread of its own; one that is unplugged is looked for until it is back.

    Args:
        module: the vendor's.
        profiles: how the device is read.
    """

    kind = KIND

    def __init__(self, module: Vendor, profiles: Profiles) -> None:
        self._module = module
        self._profiles = profiles
        self._newest: Controller | None = None
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._run, name=KIND, daemon=True)

    def start(self) -> None:
        """Begin to read."""
        self._thread.start()

    def look(self, operator: OperatorInput) -> Mapping[str, Hand]:
        """See `Source`; the page says only whether somebody is there."""
        del operator
        controller = self._newest
        return {} if controller is None else {named(controller): hand(controller, self._profiles.of(controller))}

    @property
    def controller(self) -> Controller | None:
        """What the device said last; None where it is not there."""
        return self._newest

    def close(self) -> None:
        """Let go of the device."""
        self._over.set()
        if self._thread.is_alive():
            self._thread.join(1.0)

    def serve(self) -> None:
        """Read one device from its opening until it is unplugged, or all is over."""
        try:
            mouse = self._module.open(axis_convention="hid")
        except (RuntimeError, OSError, AttributeError):  # none there, or hidapi itself is missing
            return
        try:
            while not self._over.is_set():
                self._newest = told(mouse.name, drained(mouse))
                self._over.wait(PERIOD_S)
        except Exception:  # noqa: BLE001  # the module throws what its HID library throws: whatever it is, it is gone
            pass
        finally:
            self._newest = None
            mouse.close()

    def _run(self) -> None:
        while not self._over.is_set():
            self.serve()
            self._over.wait(AGAIN_S)


def drained(mouse: Mouse) -> State:
    """The state after everything that the device has said so far."""
    state = mouse.read()
    for _ in range(PACKETS_AT_MOST):
        before = state.t
        state = mouse.read()
        if state.t == before:
            break
    return state


def told(name: str, state: State) -> Controller:
    """What the device says, as browsers say it: x right, y towards the hand, z down, turns about them alike."""
    axes = (state.x, state.y, state.z, state.roll, state.pitch, state.yaw)
    buttons = tuple(float(bool(button)) for button in state.buttons)
    return Controller(KIND, 0, name[:64], axes=tuple(max(-1.0, min(1.0, axis)) for axis in axes), buttons=buttons[:32])
