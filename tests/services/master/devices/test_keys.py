"""The keys push and turn along their axes."""

import pytest

from protocol.keys import PUSH_KEYS, TURN_KEYS
from protocol.messages import OperatorInput
from services.master.devices.keys import Keys, directions


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        ((), (0, 0, 0)),
        (("KeyQ",), (1, 0, 0)),
        (("KeyA",), (-1, 0, 0)),
        (("KeyW", "KeyE"), (0, 1, 1)),
        (("KeyS", "KeyD", "KeyQ"), (1, -1, -1)),
        (("KeyQ", "KeyA"), (0, 0, 0)),
        (("KeyQ", "KeyQ", "Space"), (1, 0, 0)),
    ],
)
def test_keys_push_along_their_axes_and_cancel_out(keys, expected):
    assert directions(keys, PUSH_KEYS) == expected
    assert directions(keys, TURN_KEYS) == (0, 0, 0)


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        (("KeyR",), (1, 0, 0)),
        (("KeyF",), (-1, 0, 0)),
        (("KeyT", "KeyY"), (0, 1, 1)),
        (("KeyG", "KeyH", "KeyR"), (1, -1, -1)),
        (("KeyT", "KeyG"), (0, 0, 0)),
    ],
)
def test_the_keys_beside_them_turn_about_the_same_axes(keys, expected):
    assert directions(keys, TURN_KEYS) == expected
    assert directions(keys, PUSH_KEYS) == (0, 0, 0)


@pytest.mark.parametrize(("keys", "held"), [((), False), (("Space",), False), (("KeyQ", "KeyA"), True)])
def test_keys_are_always_there_and_held_where_one_of_them_is_that_leads(keys, held):
    hands = Keys().look(OperatorInput(keys=keys, focused=True))
    assert {name: hand.held for name, hand in hands.items()} == {"keyboard": held}
