"""Three numbers that a hand leads."""

from dataclasses import FrozenInstanceError, fields

import pytest
from hypothesis import given
from hypothesis import strategies as st

from services.master.devices.lever import LET_GO_S, Law, Lever, pushed

LAW = Law(growth=0.12, decay=0.05, reach=0.25)

Displacement = st.floats(-LAW.reach, LAW.reach)
Deflection = st.floats(-1.0, 1.0)
Step = st.floats(0.0, 0.1)


@given(displacement=Displacement, direction=st.sampled_from([-1, 1]), dt=Step)
def test_a_held_key_grows_the_displacement_up_to_the_reach(displacement, direction, dt):
    after = pushed(displacement, direction, dt, LAW)
    assert abs(after) <= LAW.reach
    assert after * direction >= displacement * direction
    assert abs(after - displacement) <= LAW.growth * dt + 1e-12


@given(displacement=Displacement, dt=Step)
def test_without_a_key_it_decays_and_never_passes_zero(displacement, dt):
    after = pushed(displacement, 0, dt, LAW)
    assert after * displacement >= 0.0
    assert abs(after) == pytest.approx(max(0.0, abs(displacement) - LAW.decay * dt))


@given(displacement=Displacement, deflection=Deflection, first=Step, second=Step)
def test_the_speed_does_not_depend_on_how_often_it_is_asked(displacement, deflection, first, second):
    twice = pushed(pushed(displacement, deflection, first, LAW), deflection, second, LAW)
    assert twice == pytest.approx(pushed(displacement, deflection, first + second, LAW), abs=1e-12)


@given(displacement=Displacement, deflection=Deflection, dt=Step)
def test_a_deflection_pushes_as_far_as_it_goes_and_the_other_way_alike(displacement, deflection, dt):
    after = pushed(displacement, deflection, dt, LAW)
    assert after == -pushed(-displacement, -deflection, dt, LAW)
    if deflection and abs(displacement) + LAW.growth * dt < LAW.reach:
        assert after - displacement == pytest.approx(deflection * LAW.growth * dt, abs=1e-12)


def test_what_is_dragged_moves_by_shares_of_the_reach_and_stops_there():
    lever = Lever(LAW)
    lever.drag((0.4, -0.2, 0.0))
    assert lever.value == pytest.approx((0.1, -0.05, 0.0))
    lever.drag((3.0, 0.0, -3.0))
    assert lever.value == pytest.approx((0.25, -0.05, -0.25))


@given(value=Displacement, dt=Step)
def test_what_is_let_go_of_is_zero_in_a_fifth_of_a_second_and_never_passes_it(value, dt):
    lever = Lever(LAW)
    lever.take_over((value, -value, 0.0))
    lever.let_go(dt)
    assert abs(lever.value[0]) == pytest.approx(max(0.0, abs(value) - LAW.reach / LET_GO_S * dt))
    assert lever.value[1] == -lever.value[0]
    lever.let_go(LET_GO_S)
    assert lever.value == (0.0, 0.0, 0.0)


@given(beyond=st.floats(LAW.reach, 2.0 * LAW.reach), direction=st.sampled_from([-1, 1]), dt=Step)
def test_what_is_beyond_the_reach_goes_no_further_and_does_not_jump_back(beyond, direction, dt):
    """It was taken over from there, or told in other axes."""
    lever = Lever(LAW)
    lever.take_over((beyond, -beyond, 0.0))
    lever.push((direction, direction, 0.0), dt)
    for before, after in zip((beyond, -beyond), lever.value[:2], strict=True):
        expected = before if before * direction > 0.0 else before + direction * LAW.growth * dt
        assert after == pytest.approx(expected)


def test_a_law_does_not_change():
    for field in fields(LAW):
        with pytest.raises(FrozenInstanceError):
            setattr(LAW, field.name, 1.0)
