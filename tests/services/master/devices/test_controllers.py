"""Gamepads and 3-D mice: what each part leads, by one convention."""

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocol.messages import Controller, OperatorInput
from services.master.devices.controllers import Controllers, hand, other_handed
from services.master.devices.profiles import REMEMBERED, Profiles
from services.process import default_profiles
from services.process.profile import Buttons, Profile, Way, Ways
from services.process.profile_files import OwnProfile

STRAIGHT = {"dead_zone": 0.0, "expo": 0.0}
shares = st.floats(0.0, 1.0)
axes = st.tuples(*[st.floats(-1.0, 1.0)] * 4)
buttons = st.tuples(*[shares] * 17)


def one(values, index, n):
    return tuple(values if i == index else 0.0 for i in range(n))


@pytest.mark.parametrize(
    ("axis", "value", "push", "turn"),
    [
        (1, -1.0, (1.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
        (0, -1.0, (0.0, 1.0, 0.0), (0.0, 0.0, 0.0)),
        (3, -1.0, (0.0, 0.0, 1.0), (0.0, 0.0, 0.0)),
        (2, -1.0, (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    ],
)
def test_a_standard_gamepads_sticks_lead_away_left_up_and_about(axis, value, push, turn):
    pad = Controller("gamepad", standard=True, axes=one(value, axis, 4), buttons=(0.0,) * 17)
    did = hand(pad, Profiles().of(pad))
    assert (did.push, did.turn) == (push, turn)
    assert did.held


@pytest.mark.parametrize(
    ("axis", "push", "turn"),
    [
        (0, (0.0, -1.0, 0.0), (0.0, 0.0, 0.0)),
        (1, (-1.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
        (2, (0.0, 0.0, -1.0), (0.0, 0.0, 0.0)),
        (3, (0.0, 0.0, 0.0), (0.0, -1.0, 0.0)),
        (4, (0.0, 0.0, 0.0), (-1.0, 0.0, 0.0)),
        (5, (0.0, 0.0, 0.0), (0.0, 0.0, -1.0)),
    ],
)
def test_a_3d_mouse_counts_right_towards_the_hand_and_down_and_turns_alike(axis, push, turn):
    mouse = Controller("spacemouse", axes=one(1.0, axis, 6), buttons=(0.0, 0.0))
    did = hand(mouse, Profiles().of(mouse))
    assert (did.push, did.turn) == (push, turn)


def test_a_cap_that_is_pushed_up_leads_up_alone_though_a_little_of_every_other_way_goes_with_it():
    mouse = Controller("spacemouse", axes=(0.16, -0.16, -1.0, 0.16, 0.16, -0.16), buttons=(0.0, 0.0))
    did = hand(mouse, Profiles().of(mouse))
    assert (did.push, did.turn) == ((0.0, 0.0, 1.0), (0.0, 0.0, 0.0))


@given(axes=axes, buttons=buttons)
def test_nothing_leads_further_than_all_the_way(axes, buttons):
    pad = Controller("gamepad", standard=True, axes=axes, buttons=buttons)
    did = hand(pad, Profile("gamepad", scale=10.0, turn_scale=3.0, ways=default_profiles.STANDARD_GAMEPAD.ways))
    assert all(abs(value) <= 1.0 for value in (*did.push, *did.turn))


@given(axes=axes, buttons=buttons)
def test_the_other_hand_does_on_the_right_what_this_one_does_on_the_left(axes, buttons):
    pad = Controller("gamepad", standard=True, axes=axes, buttons=buttons)
    swapped = other_handed(pad)
    assert other_handed(swapped) == pad
    assert (swapped.axes[:2], swapped.axes[2:]) == (axes[2:], axes[:2])
    left = Profile("gamepad", left_hand=True, ways=default_profiles.STANDARD_GAMEPAD.ways)
    assert hand(pad, left) == hand(swapped, Profile("gamepad", ways=left.ways))


def test_a_device_without_a_standard_order_has_no_other_hand():
    pad = Controller("gamepad", axes=(1.0, 0.0, 0.0, 0.0))
    assert other_handed(pad) is pad


def test_the_scale_is_of_pushing_and_of_turning():
    ways = Ways(x=Way(axis=0), yaw=Way(axis=1))
    did = hand(
        Controller("gamepad", axes=(0.5, -0.5)), Profile("gamepad", scale=0.5, turn_scale=2.0, ways=ways, **STRAIGHT)
    )
    assert did.push == (0.25, 0.0, 0.0)
    assert did.turn == (0.0, 0.0, -1.0)


@pytest.mark.parametrize(
    ("coupled", "pressed", "counts"),
    [("released", 0.0, True), ("released", 1.0, False), ("held", 0.0, False), ("held", 1.0, True)],
)
def test_the_clutch_lets_the_hand_count_while_it_is_released_or_held(coupled, pressed, counts):
    profile = Profile("gamepad", coupled=coupled, buttons=Buttons(clutch=1))
    assert hand(Controller("gamepad", buttons=(0.0, pressed)), profile).coupled is counts


def test_a_device_without_the_clutch_s_button_counts():
    assert hand(Controller("gamepad"), Profile("gamepad", buttons=Buttons(clutch=9))).coupled


def test_of_several_pads_each_has_its_hand_by_its_number():
    operator = OperatorInput(
        controllers=(Controller("gamepad", 0), Controller("spacemouse", 1), Controller("gamepad", 2))
    )
    assert set(Controllers("gamepad", Profiles()).look(operator)) == {"gamepad", "gamepad 3"}
    assert set(Controllers("spacemouse", Profiles()).look(operator)) == {"spacemouse 2"}


def own(**said):
    return OwnProfile("mine", msgspec.convert({"kind": "gamepad", **said}, Profile), {"kind": "gamepad", **said})


def test_the_profile_that_names_a_device_most_closely_goes_before_one_for_all_and_before_none():
    profiles = Profiles((own(scale=2.0), own(device="xbox 360", scale=3.0)))
    assert profiles.of(Controller("gamepad", name="Microsoft Xbox 360 pad")).scale == 3.0
    assert profiles.of(Controller("gamepad", name="Another")).scale == 2.0
    assert profiles.of(Controller("spacemouse")) is default_profiles.SPACE_MOUSE
    assert Profiles().of(Controller("gamepad", standard=True)) is default_profiles.STANDARD_GAMEPAD
    assert Profiles().of(Controller("gamepad")) is default_profiles.OTHER_GAMEPAD
    assert Profiles().of(Controller("pointer")) is default_profiles.POINTER


def test_what_a_profile_does_not_say_stays_as_it_is_without_one():
    mine = Profiles((own(dead_zone=0.3, ways={"x": {"axis": 3}}),))
    found = mine.of(Controller("gamepad", standard=True))
    default = default_profiles.STANDARD_GAMEPAD
    assert (found.dead_zone, found.expo, found.buttons) == (0.3, default.expo, default.buttons)
    assert (found.ways.x, found.ways.y) == (Way(axis=3), default.ways.y)


def test_of_more_devices_than_are_remembered_each_has_its_profile():
    profiles = Profiles((own(device="pad 70", scale=3.0),))
    for number in range(2 * REMEMBERED):
        name = f"pad {number}"
        assert profiles.of(Controller("gamepad", name=name)).scale == (3.0 if number == 70 else 1.0)
