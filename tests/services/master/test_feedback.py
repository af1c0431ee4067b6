"""The force that a hand may feel, as laws."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from services.master.feedback import (
    FRESH_S,
    SOFT_START_S,
    STALE_S,
    Feedback,
    limited,
    share_of_fresh,
    spring_damper,
)
from sim.person.stylus import StylusState

metres = st.floats(-0.3, 0.3)
vectors = st.tuples(metres, metres, metres)
states = st.builds(StylusState, vectors, st.tuples(*[st.floats(-2.0, 2.0)] * 3))
ages = st.floats(0.0, 0.3)
DT = 1e-3


def test_it_is_equation_14():
    stylus = StylusState(position=(0.1, 0.0, -0.1), velocity=(0.0, 0.5, 0.0))
    assert spring_damper(stylus, 50.0, 2.0) == pytest.approx((-5.0, -1.0, 5.0))


@given(force=st.tuples(*[st.floats(-50.0, 50.0)] * 3), limit=st.floats(0.1, 20.0))
def test_it_never_passes_its_limit_and_keeps_its_direction(force, limit):
    bounded = limited(force, limit)
    assert math.hypot(*bounded) <= limit * (1.0 + 1e-12)
    size = math.hypot(*force)
    assert bounded == (pytest.approx([f * limit / size for f in force]) if size > limit else force)


@given(stylus=states, ages=st.lists(ages, min_size=1, max_size=30))
def test_whatever_happens_it_is_within_its_limit_and_zero_where_the_data_is_stale(stylus, ages):
    feedback = Feedback(50.0, 2.0, 3.0)
    for age in ages:
        force = feedback.force(stylus, age, DT)
        assert math.hypot(*force) <= 3.0 + 1e-12
        if age >= STALE_S:
            assert force == (0.0, 0.0, 0.0)


@given(ages=st.lists(ages, min_size=2, max_size=50))
def test_it_rises_no_faster_than_a_soft_start(ages):
    feedback = Feedback(50.0, 2.0, 3.0)
    before = feedback.gain
    for age in ages:
        feedback.force(StylusState(), age, DT)
        assert feedback.gain - before <= DT / SOFT_START_S + 1e-12
        before = feedback.gain


def test_it_begins_with_nothing_and_is_whole_after_the_soft_start():
    feedback = Feedback(50.0, 2.0, 20.0)
    stylus = StylusState(position=(0.1, 0.0, 0.0))
    forces = [-feedback.force(stylus, 0.0, DT)[0] for _ in range(round(SOFT_START_S / DT) + 1)]
    assert forces[0] == pytest.approx(5.0 * DT / SOFT_START_S)
    assert forces == sorted(forces)
    assert forces[-1] == pytest.approx(5.0)
    feedback.restart()
    assert -feedback.force(stylus, 0.0, DT)[0] == forces[0]


@given(age=ages)
def test_it_falls_along_a_line_between_fresh_and_stale(age):
    share = share_of_fresh(age)
    assert share == pytest.approx(min(1.0, max(0.0, (STALE_S - age) / (STALE_S - FRESH_S))))
    assert share_of_fresh(FRESH_S) == 1.0
    assert share_of_fresh(STALE_S) == 0.0
