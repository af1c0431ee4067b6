"""How a device's axes and buttons are read: a profile, which a person may write as a file.

One convention for every device, from where the operator looks (REP-103): x forward, y left, z up; turns about them by
the right hand: positive x rolls right, positive y tilts down, positive z turns left.
"""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec

from services.process.section import Positive, Section

Index = Annotated[int, msgspec.Meta(ge=0, le=31)]
Value = Annotated[float, msgspec.Meta(ge=-1.0, le=1.0)]


class Way(Section, frozen=True):
    """What leads along or about one axis of the convention.

    Attributes:
        axis: the device's, counted from 0; None where buttons lead, or nothing does.
        sign: 1 where the device's axis points as the convention's, -1 where it points against it.
        rest: what the device's axis says while nobody touches it.
        low: the least that it says.
        high: the most that it says.
        plus: button that leads along the convention's axis, as far as it is pressed.
        minus: button that leads against it.
    """

    axis: Index | None = None
    sign: Literal[-1, 1] = 1
    rest: Value = 0.0
    low: Value = -1.0
    high: Value = 1.0
    plus: Index | None = None
    minus: Index | None = None

    def __post_init__(self) -> None:
        if not self.low <= self.rest <= self.high or self.low == self.high:
            raise ValueError(f"rest {self.rest:g} does not lie between low {self.low:g} and high {self.high:g}")


class Ways(Section, frozen=True):
    """What leads where: along the three axes, and about them."""

    x: Way = Way()
    y: Way = Way()
    z: Way = Way()
    roll: Way = Way()
    pitch: Way = Way()
    yaw: Way = Way()


class Buttons(Section, frozen=True):
    """What the buttons do, counted from 0; None where no button does it.

    Attributes:
        clutch: the hand counts while it is let go, or while it is held.
        finish: ends the motion, as Space does.
        store: stores a waypoint.
        stop: the emergency stop.
        gripper: closes the gripper, or opens it where it is closed.
    """

    clutch: Index | None = None
    finish: Index | None = None
    store: Index | None = None
    stop: Index | None = None
    gripper: Index | None = None


class Profile(Section, frozen=True):
    """How a device is read.

    Attributes:
        kind: of device.
        device: a part of the name that browser or driver give it; empty for any of its kind.
        left_hand: for the other hand: what is left on the device and what is right change places.
        dead_zone: share of an axis' way about its rest that leads nowhere.
        crosstalk: share of the furthest deflection by which others stray that are not meant.
        expo: how much finer the middle is than the end: from 0, a straight line, to 1, the third power.
        scale: of pushing.
        turn_scale: of turning.
        coupled: whether the hand counts while the clutch is "released" or while it is "held".
        ways: what leads where.
        buttons: what they do.
    """

    kind: Literal["gamepad", "spacemouse", "pointer", "phantom"]
    device: Annotated[str, msgspec.Meta(max_length=64)] = ""
    left_hand: bool = False
    dead_zone: Annotated[float, msgspec.Meta(ge=0.0, le=0.9)] = 0.12
    crosstalk: Annotated[float, msgspec.Meta(ge=0.0, le=0.9)] = 0.0
    expo: Annotated[float, msgspec.Meta(ge=0.0, le=1.0)] = 0.4
    scale: Annotated[Positive, msgspec.Meta(le=10.0)] = 1.0
    turn_scale: Annotated[Positive, msgspec.Meta(le=10.0)] = 1.0
    coupled: Literal["released", "held"] = "released"
    ways: Ways = Ways()
    buttons: Buttons = Buttons()
