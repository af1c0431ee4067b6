"""A 3-D mouse at this computer, against a stand-in for the vendor's module."""

import importlib
from types import SimpleNamespace

import pytest

from protocol.messages import Controller, OperatorInput
from services.master.devices import spacemouse
from services.master.devices.profiles import Profiles
from services.master.devices.spacemouse import SpaceMouse, drained, told
from services.process.exceptions import RoomMissing


class Unplugged(Exception):
    """What an HID library throws is its own."""


class FakeMouse:
    """Says one packet at each read until all are said; then the last one, or that it is gone."""

    name = "SpaceMouse Compact"

    def __init__(self, packets, *, then=None):
        self.packets = list(packets)
        self.state = SimpleNamespace(t=-1.0, x=0.0, y=0.0, z=0.0, roll=0.0, pitch=0.0, yaw=0.0, buttons=[0, 0])
        self.closed = False
        self.then = then

    def read(self):
        if self.packets:
            self.state = SimpleNamespace(**{**vars(self.state), "t": self.state.t + 1.0, **self.packets.pop(0)})
        elif self.then is not None:
            self.then()
        return self.state

    def close(self):
        self.closed = True


class FakeVendor:
    """The vendor's module, with a device or without."""

    def __init__(self, mouse=None):
        self.mouse = mouse
        self.conventions = []

    def open(self, *, axis_convention):
        self.conventions.append(axis_convention)
        if self.mouse is None:
            raise RuntimeError("No connected or supported devices found.")
        return self.mouse


def test_a_state_is_told_as_browsers_tell_it_and_within_its_bounds():
    mouse = FakeMouse([{"x": 1.2, "y": -0.5, "z": 0.25, "roll": 0.1, "pitch": 0.2, "yaw": -3.0, "buttons": [0, 1]}])
    controller = told("Mouse" * 20, drained(mouse))
    assert controller.axes == (1.0, -0.5, 0.25, 0.1, 0.2, -1.0)
    assert controller.buttons == (0.0, 1.0)
    assert (controller.kind, len(controller.name)) == ("spacemouse", 64)


def test_the_newest_of_many_packets_counts():
    assert drained(FakeMouse([{"x": k / 10.0} for k in range(9)])).x == pytest.approx(0.8)


def test_without_a_device_nobody_is_there_and_nothing_fails():
    device = SpaceMouse(FakeVendor(), Profiles())
    device.serve()
    assert device.look(OperatorInput()) == {}


def test_what_it_reads_leads_by_the_convention_and_unplugged_it_is_gone():
    seen = []

    def look():
        if len(seen) == 1:
            raise Unplugged
        seen.append(device.look(OperatorInput()))

    mouse = FakeMouse([{"y": -1.0}, {"z": -1.0, "buttons": [1, 0]}], then=lambda: None)
    device = SpaceMouse(FakeVendor(mouse), Profiles())
    reads = mouse.read
    mouse.read = lambda: (look() if device.controller is not None else None, reads())[1]
    device.serve()
    ((name, hand),) = seen[0].items()
    assert (name, hand.push, hand.actions) == ("spacemouse", (1.0, 0.0, 1.0), ("finish",))
    assert device.look(OperatorInput()) == {}
    assert mouse.closed
    assert device._module.conventions == ["hid"]


def test_the_thread_reads_until_it_is_closed():
    mouse = FakeMouse([{"x": 0.5}])
    device = SpaceMouse(FakeVendor(mouse), Profiles())
    device.start()
    while device.controller is None:
        pass
    assert device.controller == Controller(
        "spacemouse", 0, mouse.name, axes=(0.5, 0.0, 0.0, 0.0, 0.0, 0.0), buttons=(0.0, 0.0)
    )
    device.close()
    assert mouse.closed


def test_without_the_vendors_module_the_extra_is_named(monkeypatch):
    def missing(name):
        raise ModuleNotFoundError(name=name)

    monkeypatch.setattr(importlib, "import_module", missing)
    with pytest.raises(RoomMissing, match=r"install retouch\[spacemouse\]"):
        spacemouse.vendor()
