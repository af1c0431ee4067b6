"""A network that is given energy by either side, and what its two ports let out of it, as laws."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.passivity import DEBT, MOST_KEPT, Port

FORCE, SPEED, STEP, DT = 20.0, 1.0, 0.012, 1e-3
CREDIT = 0.05
ROUNDING = 1e-9


def vectors(size):
    """No longer than a size."""
    part = st.floats(-size / 2.0, size / 2.0)
    return st.tuples(part, part, part)


samples = st.tuples(
    vectors(FORCE), vectors(SPEED), vectors(STEP), vectors(FORCE), st.integers(0, 60), st.integers(0, 60)
)


def _port(available):
    port = Port()
    port.available = available
    return port


ports = st.builds(_port, st.floats(-2.0 * DEBT, MOST_KEPT))


def dot(one, other):
    return sum(a * b for a, b in zip(one, other, strict=True))


@given(st.lists(samples, max_size=200))
def test_over_any_channel_no_more_comes_out_than_went_in_credit_debt_and_one_sample(sequence):
    """Each side hears any count of the other's, however old: so do delay, jitter, loss, repetition and reordering."""
    master, robot = Port(), Port(CREDIT)
    told_by_master, told_by_robot = [0.0], [0.0]
    went_in = came_out = 0.0
    for force, velocity, step, pushed, master_age, robot_age in sequence:
        master.hear(2, told_by_robot[max(0, len(told_by_robot) - 1 - master_age)])
        robot.hear(1, told_by_master[max(0, len(told_by_master) - 1 - robot_age)])
        work_on_hand = DT * dot(master.force(force, velocity), velocity)
        work_on_contact = -dot(robot.step(step, pushed), pushed)
        for port, work in ((master, work_on_hand), (robot, work_on_contact)):
            port.observe(work)
            came_out += max(0.0, work)
            went_in += max(0.0, -work)
        told_by_master.append(master.energy_in)
        told_by_robot.append(robot.energy_in)
        assert came_out <= went_in + CREDIT + DEBT + FORCE * SPEED * DT + ROUNDING


def test_a_force_that_always_pushes_along_gives_out_the_debt_and_no_more():
    port, force, velocity = Port(), (5.0, 0.0, 0.0), (0.1, 0.0, 0.0)
    given_out = 0.0
    for _ in range(5000):
        work = DT * dot(port.force(force, velocity), velocity)
        port.observe(work)
        given_out += work
    assert 0.5 * DEBT < given_out < DEBT  # without the controller 2.5 J
    assert port.force(force, velocity) != force


@given(ports, vectors(FORCE), vectors(SPEED))
def test_a_rendered_force_keeps_its_direction_and_is_never_larger_than_what_is_wanted(port, force, velocity):
    rendered = port.force(force, velocity)
    size, wanted = math.hypot(*rendered), math.hypot(*force)
    assert size <= wanted * (1.0 + 1e-12)
    assert dot(rendered, force) == pytest.approx(size * wanted, abs=1e-9)


@given(vectors(FORCE), vectors(SPEED))
def test_with_the_whole_debt_a_force_only_resists(force, velocity):
    assert dot(_port(-DEBT).force(force, velocity), velocity) <= ROUNDING


@given(ports, vectors(FORCE), vectors(SPEED), st.floats(-1e-6, 1e-6))
def test_a_force_does_not_jump_with_the_velocity_or_the_energy(port, force, velocity, little):
    other = _port(port.available + little)
    before, after = port.force(force, velocity), other.force(force, tuple(v + little for v in velocity))
    assert math.dist(before, after) <= (2.0 * math.hypot(*force) / DEBT + 100.0) * abs(little) + ROUNDING


@given(ports, vectors(STEP), vectors(FORCE))
def test_a_step_works_no_more_than_is_there_and_is_never_longer_than_what_is_wanted(port, step, force):
    let = port.step(step, force)
    assert -dot(let, force) <= max(0.0, port.available) + ROUNDING
    assert math.hypot(*let) <= math.hypot(*step) * (1.0 + 1e-12)


@given(ports, vectors(STEP))
def test_without_a_force_a_step_is_the_one_that_was_wanted_to_the_last_bit(port, step):
    assert port.step(step, (0.0, 0.0, 0.0)) is step


@given(st.lists(st.floats(-1.0, 1.0), max_size=50))
def test_what_went_in_never_falls_and_is_never_more_than_was_put_in(works):
    port, put_in = Port(CREDIT), 0.0
    for work in works:
        before = port.energy_in
        port.observe(work)
        put_in += max(0.0, -work)
        assert before <= port.energy_in <= put_in + ROUNDING


@given(st.lists(st.floats(0.0, 1.0), min_size=1, max_size=30), st.randoms(use_true_random=False))
def test_a_count_that_comes_twice_late_or_in_another_order_gives_no_more_than_the_newest(increments, random):
    counts = [sum(increments[:n]) for n in range(len(increments) + 1)]
    heard = counts[:1] + random.choices(counts, k=60)
    port = Port()
    for count in heard:
        port.hear(1, count)
    assert port.available <= min(max(heard), MOST_KEPT) + ROUNDING


def test_another_source_begins_anew_and_no_more_is_kept_than_may_come_back_at_once():
    port = Port()
    port.hear(1, 5.0)
    assert port.available == 0.0
    port.hear(1, 5.2)
    assert port.available == pytest.approx(0.2)
    port.hear(2, 900.0)
    assert port.available == pytest.approx(0.2)
    port.hear(2, 990.0)
    assert port.available == MOST_KEPT
