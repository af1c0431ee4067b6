"""Orders are balanced, and allocation is fair, repeatable and made good where somebody drops out."""

from collections import Counter
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from services.study.protocol.orders import Allocation, orders, williams
from services.study.protocol.protocol import Order, load
from services.study.protocols import SHIPPED


@pytest.mark.parametrize("number", range(2, 10))
def test_each_method_stands_at_each_place_and_follows_each_other_equally_often(number):
    methods = [f"m{k}" for k in range(number)]
    rows = williams(methods)
    assert len(rows) == (number if number % 2 == 0 else 2 * number)
    assert all(sorted(row) == methods for row in rows)
    places = Counter((place, method) for row in rows for place, method in enumerate(row))
    assert set(places.values()) == {len(rows) // number}
    assert len(places) == number * number
    follows = Counter(pair for row in rows for pair in pairwise(row))
    assert len(follows) == number * (number - 1)
    assert len(set(follows.values())) == 1


def test_the_thesis_table_is_balanced_for_places():
    protocol = load(SHIPPED["thesis"])
    table = orders(protocol.order, [method.name for method in protocol.methods])
    places = Counter((place, method) for row in table for place, method in enumerate(row))
    assert set(places.values()) == {1}
    assert len(places) == 16


@given(st.integers(1, 12), st.integers(0, 10**6), st.integers(0, 60))
def test_every_block_has_each_order_once_whatever_the_seed(number, seed, blocks):
    allocation = Allocation(Order(seed=seed), number)
    drawn = [allocation.draw() for _ in range(number * (blocks % 4 + 1))]
    for start in range(0, len(drawn), number):
        assert sorted(drawn[start : start + number]) == list(range(number))


def test_the_allocation_is_the_seed_s():
    def table(seed):
        return tuple(Allocation(Order(seed=seed, participants=16), 8).table())

    assert table(3) == table(3)
    assert len({table(seed) for seed in range(20)}) == 20


def test_who_drops_out_is_replaced_by_the_next_with_the_same_order():
    allocation = Allocation(Order(seed=1), 4)
    first = [allocation.draw() for _ in range(3)]
    allocation.dropped(first[1])
    assert allocation.draw() == first[1]
    assert sorted([*first, allocation.draw()]) == [0, 1, 2, 3]


def test_who_drops_out_is_not_replaced_where_the_protocol_says_so():
    allocation = Allocation(Order(seed=1, replace=False), 4)
    first = [allocation.draw() for _ in range(3)]
    allocation.dropped(first[1])
    assert sorted([*first, allocation.draw()]) == [0, 1, 2, 3]
