"""In which order the methods come: balanced for what each one leaves behind, and who gets which order."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from services.study.protocol.protocol import Design, Order


def williams(methods: Sequence[str]) -> tuple[tuple[str, ...], ...]:
    """Orders in which each method stands at each place, and directly after each other one, equally often.

    Their number is that of the methods where it is even, and twice as many where it is odd (E. J. Williams,
    Experimental designs balanced for the estimation of residual effects of treatments, Australian J. Sci. Res. A 2,
    1949).

    Args:
        methods: their names.
    """
    n = len(methods)
    first = [(k + 1) // 2 if k % 2 else -(k // 2) for k in range(n)]  # 0, 1, -1, 2, -2, ...
    rows = [tuple(methods[(place + shift) % n] for place in first) for shift in range(n)]
    return tuple(rows if n % 2 == 0 else [*rows, *(row[::-1] for row in rows)])


def orders(order: Order, methods: Sequence[str]) -> tuple[tuple[str, ...], ...]:
    """All orders of a design."""
    match order.design:
        case Design.WILLIAMS:
            return williams(methods)
        case Design.TABLE:
            return order.table


@dataclass
class Allocation:
    """Who gets which order: all of them once in a block, each block shuffled.

    Args:
        order: of the protocol.
        number: of different orders.
    """

    order: Order
    number: int
    _open: list[int] = field(default_factory=list)
    _drawn: int = 0

    def draw(self) -> int:
        """The order of the next participant, from 0: of one who dropped out first."""
        if self._open:
            return self._open.pop(0)
        group = self.planned(self._drawn)
        self._drawn += 1
        return group

    def dropped(self, group: int) -> None:
        """A participant with this order has dropped out, or does not count."""
        if self.order.replace:
            self._open.append(group)

    def planned(self, place: int) -> int:
        """The order at a place of the allocation, from 0, were nobody replaced."""
        block = place // self.number
        return int(np.random.default_rng((self.order.seed, block)).permutation(self.number)[place % self.number])

    def table(self) -> Iterator[int]:
        """The orders of all participants who are aimed at, were nobody replaced."""
        return (self.planned(place) for place in range(self.order.participants))
