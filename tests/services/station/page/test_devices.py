"""What the page says of the device in use."""

from dataclasses import replace

import pytest
from views import shown

from protocol.messages import MasterState, Trouble
from services.station.page.devices import devices


def told(**master):
    view = shown()
    return devices(replace(view, view=replace(view.view, master=MasterState(**master))))


def test_without_a_master_there_is_no_device():
    assert devices(shown())["device-name"] == "no device"
    assert devices(shown())["device-trouble"] == ""


def test_a_second_device_of_a_kind_is_told_by_its_number():
    assert told(device="gamepad 2") == {
        "device@data-device": "gamepad",
        "device-name": "gamepad 2",
        "device-trouble": "",
        "axes-turned": "",
    }


@pytest.mark.parametrize(("yaw", "words"), [(0.5, "29° to the left"), (-3.14, "180° to the right"), (0.004, "")])
def test_how_far_the_axes_are_turned_is_told_in_degrees(yaw, words):
    turned = told(yaw=yaw)["axes-turned"]
    assert words in turned
    assert bool(turned) is bool(words)


def test_a_device_that_has_no_other_name_is_called_by_its_own():
    assert told(device="lever")["device-name"] == "lever"


@pytest.mark.parametrize("trouble", [one for one in Trouble if one not in (Trouble.NONE, Trouble.BLIND)])
def test_every_trouble_of_a_device_is_one_sentence_that_names_the_device(trouble):
    said = told(trouble=trouble, trouble_with="gamepad and keyboard")["device-trouble"]
    assert "gamepad and keys" in said


def test_of_a_pointer_pad_that_is_gone_it_is_said_that_it_is_not_shown():
    said = told(trouble=Trouble.GONE, trouble_with="pointer")["device-trouble"]
    assert said == "The pointer pad is not shown any more: bring it forward, or use another device."
