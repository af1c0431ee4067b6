"""The page's region of the devices: which one leads the robot, and what is wrong where none does."""

from __future__ import annotations

import math

from protocol.messages import MasterState, Trouble
from services.station.page.values import Values
from services.station.page.view import Shown
from services.station.words.table import say, speech

PADS = ("keyboard", "gamepad", "pointer")
"""The devices that have a pad on the page."""


def devices(shown: Shown) -> Values:
    """The device in use, and its trouble."""
    master = shown.view.master
    return {
        "device@data-device": "" if master is None else master.device.partition(" ")[0],
        "device-name": say("device.none") if master is None else named(master.device),
        "device-trouble": "" if master is None else trouble(master),
        "axes-turned": "" if master is None else _turned(master.yaw),
    }


def _turned(yaw: float) -> str:
    """How far the axes are turned with the view; empty where they are the robot's own."""
    angle = round(math.degrees(yaw))
    return say("pad.turned_left" if angle > 0 else "pad.turned_right", angle=abs(angle)) if angle else ""


def named(device: str) -> str:
    """What people call a device, the number of a second one included."""
    kind, _, number = device.partition(" ")
    name = speech.section("device").get(kind, kind)
    return " ".join(part for part in (name, number) if part)


def trouble(master: MasterState) -> str:
    """What is wrong and what to do; empty where nothing is."""
    if master.trouble is Trouble.NONE:
        return ""
    if master.trouble is Trouble.GONE and master.trouble_with == "pointer":
        return say("device.pointer_gone")
    those = say("device.also").join(named(device) for device in master.trouble_with.split(" and "))
    return say(f"device.{master.trouble.value}", devices=those)
