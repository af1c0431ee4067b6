"""Which presses count: each once however often it is said, a stop always, and nothing else that comes late."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Mapping

from services.station.press import STOPS, Press

PRESSES_KEPT = 64
LOADS_REMEMBERED = 32
NUMBERS_REMEMBERED = 64


class Presses:
    """The presses that wait for the station's next step, and what has become of those before.

    A number that was heard is acknowledged to the page that said it, which says it no more; so is one that was
    refused, with the difference that the page tells its person.
    """

    def __init__(self) -> None:
        self._waiting: list[Press] = []
        self._heard: OrderedDict[str, OrderedDict[int, bool]] = OrderedDict()

    def is_new(self, load: str, number: int) -> bool:
        """Whether this press of a loaded page was not heard before."""
        return number not in self._heard.get(load, {})

    def settle(self, load: str, number: int, accepted: bool) -> None:
        """Remember what became of a press."""
        numbers = self._heard.setdefault(load, OrderedDict())
        self._heard.move_to_end(load)
        numbers[number] = accepted
        if len(numbers) > NUMBERS_REMEMBERED:
            numbers.popitem(last=False)
        if len(self._heard) > LOADS_REMEMBERED:
            self._heard.popitem(last=False)

    def settled(self, load: str) -> dict[bool, tuple[int, ...]]:
        """The numbers of a loaded page that were accepted (True) and refused (False)."""
        numbers: Mapping[int, bool] = self._heard.get(load, {})
        return {fate: tuple(number for number, is_so in numbers.items() if is_so is fate) for fate in (True, False)}

    def add(self, press: Press) -> bool:
        """Keep a press for the next step, a stop before all others; whether there was room."""
        if press.action in STOPS:
            if press not in self._waiting:
                self._waiting.insert(0, press)
            return True
        if len(self._waiting) >= PRESSES_KEPT:
            return False
        self._waiting.append(press)
        return True

    def take(self) -> list[Press]:
        """The presses since the last call."""
        taken, self._waiting = self._waiting, []
        return taken
