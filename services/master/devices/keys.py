"""The keys of the operator's page: pushed all the way, or not at all."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from protocol.keys import PUSH_KEYS, STEERING, TURN_KEYS, Direction
from protocol.messages import OperatorInput
from services.master.devices.hand import Hand


def directions(keys: Collection[str], table: Mapping[str, Direction]) -> tuple[int, int, int]:
    """Which way each axis is pushed by a table's keys: -1, 0 or 1; keys against each other cancel out."""
    axes = [0, 0, 0]
    for key in set(keys) & table.keys():
        axis, sign = table[key]
        axes[axis] += sign
    return (axes[0], axes[1], axes[2])


class Keys:
    """Keys that push and keys that turn; they are there wherever there is a page."""

    kind = "keyboard"

    def look(self, operator: OperatorInput) -> Mapping[str, Hand]:
        """What is held."""
        push, turn = directions(operator.keys, PUSH_KEYS), directions(operator.keys, TURN_KEYS)
        return {self.kind: Hand(push, turn, held=not STEERING.isdisjoint(operator.keys))}

    def close(self) -> None:
        """The page reads it."""
