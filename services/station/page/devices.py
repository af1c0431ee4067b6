"""The page's region of the devices: which one leads the robot, and what is wrong where none does."""

from __future__ import annotations

from protocol.messages import MasterState, Trouble
from services.station.page.values import Values
from services.station.page.view import Shown

NAMES = {
    "keyboard": "keys",
    "gamepad": "gamepad",
    "spacemouse": "3-D mouse",
    "pointer": "pointer pad",
    "phantom": "stylus",
    "stylus": "scripted stylus",
}
"""What people call the devices that a master names."""

PADS = (
    ("keyboard", "Keys"),
    ("gamepad", "Gamepad"),
    ("pointer", "Pointer pad"),
)
"""The devices that have a pad on the page, and the words on their tabs."""

TROUBLES = {
    Trouble.TWO: "Two devices at once, {}: let go of one.",
    Trouble.GONE: "The {} is gone: plug it in again, or use another device.",
    Trouble.NOT_AT_REST: "The {} is not at rest: let go of it, and it counts. If you have, calibrate it.",
    Trouble.ABSENT: "No {} here: plug it in and press one of its buttons.",
}


def devices(shown: Shown) -> Values:
    """The device in use, and its trouble."""
    master = shown.view.master
    return {
        "device@data-device": "" if master is None else master.device.partition(" ")[0],
        "device-name": "no device" if master is None else named(master.device),
        "device-trouble": "" if master is None else trouble(master),
    }


def named(device: str) -> str:
    """What people call a device, the number of a second one included."""
    kind, _, number = device.partition(" ")
    return " ".join(part for part in (NAMES.get(kind, kind), number) if part)


def trouble(master: MasterState) -> str:
    """What is wrong and what to do; empty where nothing is."""
    words = TROUBLES.get(master.trouble, "")
    return words.format(" and ".join(named(device) for device in master.trouble_with.split(" and ")))
