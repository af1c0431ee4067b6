"""The page's region of the devices: which one leads the robot, and what is wrong where none does."""

from __future__ import annotations

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
    }


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
