"""Whoever fails waits, twice as long each time, whether anybody is called so or not; and keeps nobody else out."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from services.process.clock import ManualClock
from services.station.page.login.waits import (
    FORGOTTEN_NS,
    FREE_OF_A_NAME,
    FREE_OF_AN_ADDRESS,
    LONGEST_NS,
    REMEMBERED,
    Waits,
)

HERE, THERE = "192.0.2.1", "192.0.2.2"
LONGEST_S = LONGEST_NS // 1_000_000_000


@pytest.fixture
def clock():
    return ManualClock()


@pytest.fixture
def waits(clock):
    return Waits(clock)


def fail(waits, times, name="anna", address=HERE):
    for _ in range(times):
        waits.failed(name, address)


def test_a_few_failures_are_free_and_then_each_wait_is_twice_as_long(waits, clock):
    fail(waits, FREE_OF_A_NAME - 1)
    assert waits.left_s("anna", HERE) == 0
    lengths = []
    for _ in range(11):
        fail(waits, 1)
        lengths.append(waits.left_s("anna", HERE))
        clock.advance(lengths[-1])
        assert waits.left_s("anna", HERE) == 0
    assert lengths == [1, 2, 4, 8, 16, 32, 64, 128, 256, LONGEST_S, LONGEST_S]


def test_a_wait_runs_down_in_whole_seconds(waits, clock):
    fail(waits, FREE_OF_A_NAME + 2)
    told = []
    for _ in range(5):
        told.append(waits.left_s("anna", HERE))
        clock.advance(1.0)
    assert told == [4, 3, 2, 1, 0]
    fail(waits, 1)
    clock.advance(0.5)
    assert waits.left_s("anna", HERE) == 8


def test_a_name_waits_wherever_it_is_tried_and_however_it_is_typed(waits):
    fail(waits, FREE_OF_A_NAME + 2, "Anna")
    for name in ("Anna", "anna", "ANNA"):
        assert waits.left_s(name, THERE) == 4
    assert waits.left_s("bob", THERE) == 0


def test_an_address_waits_whatever_name_is_tried_there(waits):
    for number in range(FREE_OF_AN_ADDRESS + 1):
        waits.failed(f"name {number}", HERE)
    assert waits.left_s("somebody else", HERE) == 2
    assert waits.left_s("somebody else", THERE) == 0


@pytest.mark.parametrize(
    ("tried", "judged", "same"),
    [
        ("2001:db8:1:2::1", "2001:db8:1:2:ffff::9", True),
        ("2001:db8:1:2::1", "2001:db8:1:3::1", False),
        ("::ffff:192.0.2.1", "192.0.2.1", True),
        ("192.0.2.1", "192.0.2.3", False),
        ("fe80::1%eth0", "fe80::2%eth1", True),
        ("", "", True),
    ],
)
def test_addresses_that_one_machine_can_have_wait_together(waits, tried, judged, same):
    for number in range(FREE_OF_AN_ADDRESS):
        waits.failed(f"name {number}", tried)
    assert (waits.left_s("somebody else", judged) > 0) == same


def test_who_gets_in_waits_no_more_and_is_not_kept_out_by_others_who_try_the_name(waits):
    fail(waits, FREE_OF_A_NAME)
    waits.succeeded("anna", HERE)
    assert waits.left_s("anna", HERE) == 0
    fail(waits, FREE_OF_A_NAME + 5, "anna", THERE)
    assert waits.left_s("anna", THERE) == 32
    assert waits.left_s("anna", HERE) == 0


def test_who_gets_in_does_not_make_good_what_was_tried_from_there_for_others(waits):
    for number in range(FREE_OF_AN_ADDRESS):
        waits.failed(f"name {number}", HERE)
    waits.succeeded("eve", HERE)
    assert waits.left_s("anna", HERE) == 1


def test_a_failure_is_forgotten_in_the_end(waits, clock):
    fail(waits, FREE_OF_A_NAME + 20)
    clock.advance(FORGOTTEN_NS / 1e9)
    fail(waits, FREE_OF_A_NAME - 1)
    assert waits.left_s("anna", HERE) == 0


def test_no_number_of_names_fills_the_memory(waits):
    for number in range(REMEMBERED + 100):
        waits.failed(f"name {number}", f"10.{number >> 16}.{(number >> 8) & 255}.{number & 255}")
        waits.succeeded(f"name {number}", THERE)
    assert len(waits._known) == REMEMBERED
    assert len(waits._addresses._failures) == REMEMBERED


@given(st.lists(st.tuples(st.sampled_from(["anna", "nobody"]), st.booleans()), max_size=30))
def test_somebody_who_does_not_exist_waits_as_anybody_does(tries):
    clock = ManualClock()
    first, second = Waits(clock), Waits(clock)
    swapped = {"anna": "nobody", "nobody": "anna"}
    for name, elsewhere in tries:
        address = THERE if elsewhere else HERE
        assert first.left_s(name, address) == second.left_s(swapped[name], address)
        first.failed(name, address)
        second.failed(swapped[name], address)
