"""Which orders were given and became free again, from the journal alone."""

from __future__ import annotations

from collections.abc import Iterable

from services.study.events import Dropped, Enrolled, Entry, Withdrawn
from services.study.protocol.orders import Allocation
from services.study.protocol.protocol import Order


def allocated(order: Order, number: int, entries: Iterable[Entry]) -> Allocation:
    """As it stands after all who were enrolled and dropped out; a place becomes free once, however often they leave.

    Args:
        order: of the protocol.
        number: of different orders.
        entries: of the journal.
    """
    allocation, taken = Allocation(order, number), dict[int, int]()
    for entry in entries:
        match entry.event:
            case Enrolled(participant=participant, group=group):
                allocation.draw()
                taken[participant] = group
            case Dropped(participant=participant, replaced=True) | Withdrawn(participant=participant):
                if participant in taken:
                    allocation.dropped(taken.pop(participant))
            case _:
                pass
    return allocation
