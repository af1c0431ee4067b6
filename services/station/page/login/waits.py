"""How long somebody has to wait who gave wrong passwords: twice as long each time, by their name and by their address.

A name that nobody has waits as any other does. Whoever has logged in from an address before waits there by the address
alone: nobody keeps others out by failing in their name.
"""

from __future__ import annotations

import ipaddress
import math
from collections import OrderedDict
from dataclasses import dataclass, replace

from services.accounts.account import key
from services.process.clock import Clock

FREE_OF_A_NAME = 3
FREE_OF_AN_ADDRESS = 10
"""So many may fail before anybody waits; several people may share an address."""

FIRST_NS = 1_000_000_000
LONGEST_NS = 300 * 1_000_000_000
"""The first wait, and the longest."""

FORGOTTEN_NS = 3600 * 1_000_000_000
"""A failure counts for so long after the last one."""

REMEMBERED = 4096
"""Names and addresses, each."""

_SHARED_BITS = 64
"""Of an address of version 6 that whoever has one has all others of, too."""


@dataclass(frozen=True)
class _Failures:
    count: int
    last_ns: int

    def wait_ns(self, free: int) -> int:
        """After the last of them."""
        return 0 if self.count < free else min(LONGEST_NS, FIRST_NS << min(self.count - free, 16))


class _Counted:
    """Failures, by whom they are counted for.

    Args:
        free: so many may fail before anybody waits.
    """

    def __init__(self, free: int) -> None:
        self._free = free
        self._failures: OrderedDict[str, _Failures] = OrderedDict()

    def left_ns(self, whose: str, now_ns: int) -> int:
        found = self._of(whose, now_ns)
        return max(0, found.last_ns + found.wait_ns(self._free) - now_ns)

    def failed(self, whose: str, now_ns: int) -> None:
        found = self._of(whose, now_ns)
        self._failures[whose] = replace(found, count=found.count + 1, last_ns=now_ns)
        self._failures.move_to_end(whose)
        if len(self._failures) > REMEMBERED:
            self._failures.popitem(last=False)

    def forgive(self, whose: str) -> None:
        self._failures.pop(whose, None)

    def _of(self, whose: str, now_ns: int) -> _Failures:
        found = self._failures.get(whose)
        return found if found is not None and now_ns - found.last_ns < FORGOTTEN_NS else _Failures(0, now_ns)


class Waits:
    """Who has to wait, and for how long.

    Args:
        clock: by which they wait.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._names = _Counted(FREE_OF_A_NAME)
        self._addresses = _Counted(FREE_OF_AN_ADDRESS)
        self._known: OrderedDict[tuple[str, str], None] = OrderedDict()

    def left_s(self, name: str, address: str) -> int:
        """Whole seconds until somebody of this name may try again from there; 0 where they may now."""
        now_ns, whose, where = self._clock.now_ns(), key(name), _network(address)
        left_ns = self._addresses.left_ns(where, now_ns)
        if (whose, where) not in self._known:
            left_ns = max(left_ns, self._names.left_ns(whose, now_ns))
        return math.ceil(left_ns / 1e9)

    def failed(self, name: str, address: str) -> None:
        """A password was wrong, or there is nobody of the name."""
        now_ns = self._clock.now_ns()
        self._names.failed(key(name), now_ns)
        self._addresses.failed(_network(address), now_ns)

    def succeeded(self, name: str, address: str) -> None:
        """Somebody has logged in. What failed at their address still counts: it may have been for others' names."""
        whose, where = key(name), _network(address)
        self._names.forgive(whose)
        self._known[whose, where] = None
        self._known.move_to_end((whose, where))
        if len(self._known) > REMEMBERED:
            self._known.popitem(last=False)


def _network(address: str) -> str:
    """By which an address is counted."""
    try:
        known = ipaddress.ip_address(address.partition("%")[0])
    except ValueError:
        return address
    if isinstance(known, ipaddress.IPv4Address):
        return str(known)
    if known.ipv4_mapped is not None:
        return str(known.ipv4_mapped)
    return str(ipaddress.ip_network((known, _SHARED_BITS), strict=False))
