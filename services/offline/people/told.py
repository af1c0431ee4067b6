"""What the page says of a device on which a hand does something: profiles and keys, read backwards."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import msgspec
import numpy as np
from numpy.typing import NDArray

from protocol.keys import PUSH_KEYS, TURN_KEYS, Direction
from protocol.messages import Controller
from services.process.profile import Profile, Way

Array = NDArray[np.float64]

STICKS, BUTTONS = 4, 17
"""Of the W3C's standard gamepad."""

CAP, CAP_BUTTONS = 6, 2
"""Of a 3-D mouse."""


def keys(pushed: Array) -> tuple[str, ...]:
    """The keys that push so.

    Args:
        pushed: along x, y, z and about them, -1, 0 or 1 each, shape (6,).
    """
    return (*_held(PUSH_KEYS, pushed[:3]), *_held(TURN_KEYS, pushed[3:]))


def gamepad(pushed: Array, profile: Profile, buttons: Collection[int] = ()) -> Controller:
    """A standard gamepad that is pushed so.

    Args:
        pushed: how far each way is deflected, from -1 to 1, shape (6,).
        profile: by which it is read.
        buttons: that are pressed beside.
    """
    return _controller(Controller("gamepad", standard=True), pushed, profile, (STICKS, BUTTONS), buttons)


def space_mouse(pushed: Array, profile: Profile, buttons: Collection[int] = ()) -> Controller:
    """A 3-D mouse that is pushed so; see `gamepad`."""
    return _controller(Controller("spacemouse"), pushed, profile, (CAP, CAP_BUTTONS), buttons)


def pointer(far: Array, profile: Profile, *, down: bool) -> Controller:
    """The pad on which was dragged so far.

    Args:
        far: in reaches, shape (6,).
        profile: by which it is read.
        down: the pen is on it.
    """
    return _controller(Controller("pointer"), far, profile, (CAP, 1), (0,) if down else ())


def _held(table: Mapping[str, Direction], pushed: Array) -> tuple[str, ...]:
    return tuple(key for key, (axis, sign) in table.items() if pushed[axis] == sign)


def _controller(
    resting: Controller, values: Array, profile: Profile, parts: tuple[int, int], pressed: Collection[int]
) -> Controller:
    """A device of so many axes and buttons, led so."""
    said, held = [0.0] * parts[0], [0.0] * parts[1]
    ways = profile.ways
    for way, value in zip((ways.x, ways.y, ways.z, ways.roll, ways.pitch, ways.yaw), values.tolist(), strict=True):
        _lead(way, value, said, held)
    for button in pressed:
        held[button] = 1.0
    return msgspec.structs.replace(resting, axes=tuple(said), buttons=tuple(held))


def _lead(way: Way, value: float, axes: list[float], buttons: list[float]) -> None:
    if way.axis is not None:
        axes[way.axis] = way.rest + way.sign * value
    if way.plus is not None and value > 0.0:
        buttons[way.plus] = value
    if way.minus is not None and value < 0.0:
        buttons[way.minus] = -value
