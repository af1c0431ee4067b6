"""What the keys in an `OperatorInput` do: one table for the page that shows them and the device that obeys them.

Keys are named by their place (`KeyboardEvent.code`), whatever is printed on them.
"""

from __future__ import annotations

from collections.abc import Mapping

Direction = tuple[int, int]
"""An axis of the base frame, 0 to 2, and the sign along it."""

PUSH_KEYS: Mapping[str, Direction] = {
    "KeyQ": (0, +1),
    "KeyA": (0, -1),
    "KeyW": (1, +1),
    "KeyS": (1, -1),
    "KeyE": (2, +1),
    "KeyD": (2, -1),
}
"""Keys that displace along an axis, as in the thesis."""

TURN_KEYS: Mapping[str, Direction] = {
    "KeyR": (0, +1),
    "KeyF": (0, -1),
    "KeyT": (1, +1),
    "KeyG": (1, -1),
    "KeyY": (2, +1),
    "KeyH": (2, -1),
}
"""Keys that rotate about one: the thesis' keys, which turn about the tool's axes there and about the base's here."""

STEERING = frozenset({*PUSH_KEYS, *TURN_KEYS})
"""What the device obeys: a key that does nothing never keeps the others waiting."""
