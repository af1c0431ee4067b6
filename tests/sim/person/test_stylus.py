import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.person.stylus import Stylus, StylusState

DT = 1e-3
Coordinate = st.floats(-0.2, 0.2)
Vector = st.tuples(Coordinate, Coordinate, Coordinate)


def spring(state: StylusState, stiffness: float) -> tuple[float, float, float]:
    x, y, z = state.position
    return (-stiffness * x, -stiffness * y, -stiffness * z)


def energy(stylus: Stylus, stiffness: float) -> float:
    kinetic = 0.5 * stylus.mass * sum(v * v for v in stylus.state.velocity)
    return kinetic + 0.5 * stiffness * sum(x * x for x in stylus.state.position)


def test_free_motion_dies_out_exponentially():
    stylus = Stylus(mass=0.2, damping=1.0, state=StylusState(velocity=(0.1, 0.0, -0.2)))
    for _ in range(300):
        stylus.step((0.0, 0.0, 0.0), DT)
    expected = math.exp(-1.0 / 0.2 * 0.3)
    assert stylus.state.velocity == pytest.approx((0.1 * expected, 0.0, -0.2 * expected), rel=5e-3)


def test_a_spring_swings_as_the_closed_form_says():
    m, c, k, x0 = 0.15, 0.3, 50.0, 0.1
    stylus = Stylus(mass=m, damping=c, state=StylusState(position=(x0, 0.0, -x0)))
    sigma = c / (2 * m)
    omega = math.sqrt(k / m - sigma**2)
    for step in range(1, 1001):
        x, y, z = stylus.step(spring(stylus.state, k), DT).position
        t = step * DT
        expected = x0 * math.exp(-sigma * t) * (math.cos(omega * t) + sigma / omega * math.sin(omega * t))
        assert x == pytest.approx(expected, abs=0.02 * x0)
        assert y == 0.0
        assert z == -x


@settings(max_examples=25)
@given(position=Vector, velocity=Vector)
def test_without_a_hand_the_energy_falls(position, velocity):
    stylus = Stylus(state=StylusState(position, velocity))
    before = energy(stylus, 50.0)
    for _ in range(3):
        for _ in range(100):
            stylus.step(spring(stylus.state, 50.0), DT)
        after = energy(stylus, 50.0)
        assert after <= before
        before = after


def test_the_handle_turns_as_it_is_held_and_stays_when_it_is_let_go():
    """The gimbal has neither motors nor springs; turning it does not move the tip."""
    stylus = Stylus()
    for angle in (0.1, 0.3, -0.2):
        assert stylus.step((0.0, 0.0, 0.0), DT, (angle, 0.0, 2.0 * angle)).rotation == (angle, 0.0, 2.0 * angle)
    assert stylus.step((0.1, 0.0, 0.0), DT).rotation == (-0.2, 0.0, -0.4)
    assert stylus.state.position[1:] == (0.0, 0.0)


@settings(max_examples=25)
@given(force=st.tuples(*[st.floats(-100.0, 100.0)] * 3))
def test_it_stops_at_the_edge_of_its_workspace(force):
    stylus = Stylus(reach=0.2)
    for _ in range(200):
        state = stylus.step(force, DT)
        for x, v in zip(state.position, state.velocity, strict=True):
            assert abs(x) <= 0.2
            assert abs(x) < 0.2 or v == 0.0
