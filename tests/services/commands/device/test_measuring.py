"""What was measured of a device becomes a profile that reads it at rest as nothing and at its ends as everything."""

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocol.messages import Controller
from services.commands.device.measuring import LEAST_DEAD_ZONE, MOST_DEAD_ZONE, Axis, measured, profile, remarks
from services.master.devices.curve import deflection
from services.process.profile import Profile, Way


def said(*axes, standard=True, kind="gamepad"):
    return Controller(kind, 0, "Some pad", standard, axes)


def test_an_axis_is_measured_by_its_rest_its_straying_and_its_ends():
    resting = [said(0.02), said(0.04), said(0.03)]
    (axis,) = measured(resting, [said(-0.9), said(0.95)])
    assert axis == Axis(0.03, pytest.approx(0.01), -0.9, 0.95)
    assert axis.moved
    assert not axis.is_trigger


def test_a_trigger_is_known_by_where_it_rests_and_an_axis_that_nobody_moved_too():
    trigger, still = measured([said(-1.0, 0.0)] * 3, [said(1.0, 0.1), said(-1.0, 0.0)])
    assert trigger.is_trigger
    assert not still.moved
    assert remarks((trigger, still)) == ["axis 0 rests at -1.00: a trigger", "axis 1 was not moved"]


def test_a_worn_out_stick_is_said_to_be_one():
    (axis,) = measured([said(-0.3), said(0.3), said(0.0)], [said(-1.0), said(1.0)])
    assert remarks((axis,)) == ["axis 0 strays by 30 % at rest: worn out, let nothing be led by it"]


@given(
    rest=st.floats(-0.3, 0.3),
    noise=st.floats(0.0, 0.1),
    low=st.floats(-1.0, -0.7),
    high=st.floats(0.7, 1.0),
)
def test_a_measured_stick_leads_nowhere_at_rest_and_all_the_way_at_its_ends(rest, noise, low, high):
    resting = [said(*[value] * 4) for value in (rest - noise, rest, rest + noise)]
    moving = [said(*[value] * 4) for value in (low, high)]
    made = msgspec.convert(profile(resting[0], measured(resting, moving)), Profile)
    assert LEAST_DEAD_ZONE <= made.dead_zone <= MOST_DEAD_ZONE
    for one in resting:
        assert deflection(one, made.ways.x, made) == 0.0
    assert deflection(moving[0], made.ways.x, made) == pytest.approx(1.0, abs=0.01)
    assert deflection(moving[1], made.ways.x, made) == pytest.approx(-1.0, abs=0.01)


def test_of_a_device_without_a_standard_order_the_sticks_lead_and_no_trigger():
    resting = [said(0.0, 0.0, -1.0, 0.0, 0.0, -1.0, standard=False)] * 3
    moving = [said(*[value] * 6, standard=False) for value in (-1.0, 1.0)]
    made = msgspec.convert(profile(resting[0], measured(resting, moving)), Profile)
    assert (made.ways.y, made.ways.x, made.ways.yaw, made.ways.z) == (
        Way(axis=0, sign=-1),
        Way(axis=1, sign=-1),
        Way(axis=3, sign=-1),
        Way(axis=4, sign=-1),
    )


def test_an_axis_that_was_not_moved_keeps_its_range():
    made = profile(said(0.01, 0.0, 0.0, 0.0), measured([said(0.01, 0, 0, 0)], [said(0.01, 0, 0, 0)]))
    assert made["ways"]["y"] == {"axis": 0, "sign": -1, "rest": 0.01}


def test_a_3d_mouse_keeps_what_each_axis_leads():
    mouse = said(*[0.0] * 6, kind="spacemouse", standard=False)
    made = profile(mouse, measured([mouse], [said(*[0.9] * 6, kind="spacemouse")]))
    assert {name: way["axis"] for name, way in made["ways"].items()} == {
        "x": 1,
        "y": 0,
        "z": 2,
        "roll": 4,
        "pitch": 3,
        "yaw": 5,
    }
