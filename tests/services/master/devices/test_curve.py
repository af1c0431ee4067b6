"""How an axis becomes a deflection: the laws of the dead zone and the curve, and of what strays from other axes."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocol.messages import Controller
from services.master.devices.curve import deflection, meant, position, spanned
from services.process.profile import Profile, Way

values = st.floats(-1.0, 1.0)
profiles = st.builds(Profile, st.just("gamepad"), dead_zone=st.floats(0.0, 0.9), expo=st.floats(0.0, 1.0))
STICK = Way(axis=0)


def deflected(value, profile, way=STICK):
    return deflection(Controller("gamepad", axes=(value,)), way, profile)


@given(value=values, profile=profiles)
def test_it_is_odd(value, profile):
    assert deflected(-value, profile) == -deflected(value, profile)


@given(values=st.tuples(values, values), profile=profiles)
def test_it_is_monotonic(values, profile):
    less, more = sorted(values)
    assert deflected(less, profile) <= deflected(more, profile)


@given(value=values, step=st.floats(0.0, 0.01), profile=profiles)
def test_it_is_continuous(value, step, profile):
    """Nowhere is it steeper than at its end."""
    slope = (1.0 + 2.0 * profile.expo) / (1.0 - profile.dead_zone)
    after = min(1.0, value + step)
    assert abs(deflected(after, profile) - deflected(value, profile)) <= slope * (after - value) + 1e-12


@given(share=st.floats(0.0, 1.0), profile=profiles)
def test_nothing_leads_from_within_the_dead_zone_and_the_end_is_all(share, profile):
    assert deflected(share * profile.dead_zone, profile) == 0.0
    assert deflected(1.0, profile) == pytest.approx(1.0)
    assert deflected(-1.0, profile) == pytest.approx(-1.0)


def test_between_them_it_is_a_line_and_a_third_power():
    profile = Profile("gamepad", dead_zone=0.2, expo=0.25)
    w = (0.6 - 0.2) / 0.8
    assert deflected(0.6, profile) == pytest.approx(0.75 * w + 0.25 * w**3)


@given(value=values, profile=profiles)
def test_the_sign_turns_it_round(value, profile):
    assert deflected(value, profile, Way(axis=0, sign=-1)) == -deflected(value, profile)


@given(rest=st.floats(-0.5, 0.5), share=st.floats(-1.0, 1.0))
def test_an_axis_is_a_share_of_its_range_from_where_it_rests(rest, share):
    way = Way(axis=0, rest=rest, low=-0.9, high=0.8)
    side = 0.8 - rest if share > 0.0 else rest + 0.9
    assert spanned(rest + share * side, way) == pytest.approx(share, abs=1e-12)


def test_a_trigger_that_rests_at_minus_one_has_one_side_and_leads_nowhere_at_rest():
    trigger = Way(axis=0, rest=-1.0)
    assert [spanned(value, trigger) for value in (-1.0, 0.0, 1.0)] == [0.0, 0.5, 1.0]


def test_beyond_what_was_measured_it_goes_no_further():
    assert spanned(1.0, Way(axis=0, low=-0.5, high=0.5)) == 1.0
    assert spanned(-1.0, Way(axis=0, low=-0.5, high=0.5)) == -1.0


@given(plus=st.floats(0.0, 1.0), minus=st.floats(0.0, 1.0), profile=profiles)
def test_two_buttons_lead_against_each_other(plus, minus, profile):
    pad = Controller("gamepad", buttons=(minus, plus))
    other = Controller("gamepad", buttons=(plus, minus))
    assert deflection(pad, Way(plus=1, minus=0), profile) == -deflection(other, Way(plus=1, minus=0), profile)
    if plus == minus:
        assert deflection(pad, Way(plus=1, minus=0), profile) == 0.0


@pytest.mark.parametrize("way", [Way(), Way(axis=4), Way(plus=3, minus=9)])
def test_a_part_that_the_device_has_not_leads_nowhere(way):
    assert deflection(Controller("gamepad", axes=(1.0,), buttons=(1.0,)), way, Profile("gamepad")) == 0.0
    assert position(Controller("pointer", axes=(1.0,)), way) == 0.0


deflections = st.lists(values, min_size=6, max_size=6)
crosstalks = st.floats(0.0, 0.9)


@given(deflections=deflections, crosstalk=crosstalks)
def test_what_is_deflected_furthest_counts_whole_and_nothing_counts_more_than_it_is(deflections, crosstalk):
    counted = meant(deflections, crosstalk)
    furthest = max(range(6), key=lambda i: abs(deflections[i]))
    assert counted[furthest] == pytest.approx(deflections[furthest])
    assert all(abs(one) <= abs(said) + 1e-12 for one, said in zip(counted, deflections, strict=True))
    assert all(one * said >= 0.0 for one, said in zip(counted, deflections, strict=True))


@given(furthest=values, share=st.floats(-1.0, 1.0), crosstalk=crosstalks)
def test_what_strays_with_it_by_less_than_the_crosstalk_is_not_meant(furthest, share, crosstalk):
    assert meant([0.99 * share * crosstalk * furthest, furthest], crosstalk)[0] == 0.0


@given(deflections=deflections, others=deflections, crosstalk=crosstalks)
def test_what_is_meant_is_continuous_in_all_that_is_deflected(deflections, others, crosstalk):
    """No steeper than 2 / (1 - c)."""
    step = max(abs(one - other) for one, other in zip(deflections, others, strict=True))
    pairs = zip(meant(deflections, crosstalk), meant(others, crosstalk), strict=True)
    assert all(abs(one - other) <= 2.0 / (1.0 - crosstalk) * step + 1e-12 for one, other in pairs)


@given(deflections=deflections)
def test_without_crosstalk_all_of_it_is_meant(deflections):
    assert meant(deflections, 0.0) == deflections


@given(value=st.floats(-1e3, 1e3))
def test_what_is_dragged_stands_where_it_was_dragged_to(value):
    assert position(Controller("pointer", axes=(value,)), Way(axis=0, sign=-1)) == -value


def test_a_way_that_rests_beyond_its_range_is_none():
    with pytest.raises(ValueError, match=r"rest 0\.5 does not lie between low -1 and high 0\.4"):
        Way(axis=0, rest=0.5, high=0.4)
