"""Devices that deflect, as browser or driver read them: gamepads and 3-D mice."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from protocol.messages import Controller, OperatorInput, Vector3
from services.master.devices.curve import deflection, meant
from services.master.devices.hand import Hand
from services.master.devices.profiles import Profiles
from services.process.profile import Profile

PRESSED = 0.5
"""From here on a button is pressed."""


class Controllers:
    """All devices of one kind that the page reads.

    Args:
        kind: "gamepad" or "spacemouse".
        profiles: how each is read.
    """

    def __init__(self, kind: str, profiles: Profiles) -> None:
        self.kind = kind
        self._profiles = profiles

    def look(self, operator: OperatorInput) -> Mapping[str, Hand]:
        """What is deflected and pressed."""
        return {
            named(controller): hand(controller, self._profiles.of(controller))
            for controller in operator.controllers
            if controller.kind == self.kind
        }

    def close(self) -> None:
        """The page reads it."""


def named(controller: Controller) -> str:
    """By what people and messages call a device: its kind, and from the second one on its number."""
    return controller.kind if controller.number == 0 else f"{controller.kind} {controller.number + 1}"


def hand(controller: Controller, profile: Profile) -> Hand:
    """What a hand does at a device that deflects."""
    if profile.left_hand:
        controller = other_handed(controller)
    ways = profile.ways
    each = (ways.x, ways.y, ways.z, ways.roll, ways.pitch, ways.yaw)
    deflections = meant([deflection(controller, way, profile) for way in each], profile.crosstalk)
    push = _scaled(deflections[:3], profile.scale)
    turn = _scaled(deflections[3:], profile.turn_scale)
    return Hand(
        push=push,
        turn=turn,
        held=any((*push, *turn)),
        coupled=coupled(controller, profile),
        actions=actions(controller, profile),
    )


def coupled(controller: Controller, profile: Profile) -> bool:
    """Whether the clutch lets the hand count."""
    clutch = profile.buttons.clutch
    return clutch is None or is_pressed(controller, clutch) == (profile.coupled == "held")


def actions(controller: Controller, profile: Profile) -> tuple[str, ...]:
    """The actions whose buttons are pressed."""
    buttons = profile.buttons
    named_ = {"finish": buttons.finish, "store": buttons.store, "stop": buttons.stop, "grip": buttons.gripper}
    return tuple(action for action, button in named_.items() if is_pressed(controller, button))


def is_pressed(controller: Controller, button: int | None) -> bool:
    """Whether a button of the device is pressed; one that it has not is none."""
    return button is not None and button < len(controller.buttons) and controller.buttons[button] >= PRESSED


def other_handed(controller: Controller) -> Controller:
    """What is left on a standard gamepad and what is right change places; any other device stays as it is."""
    if not controller.standard:
        return controller
    axes = _swapped(controller.axes, ((0, 2), (1, 3)))
    buttons = _swapped(controller.buttons, ((4, 5), (6, 7), (10, 11)))
    return Controller(controller.kind, controller.number, controller.name, controller.standard, axes, buttons)


def _swapped(values: tuple[float, ...], pairs: Iterable[tuple[int, int]]) -> tuple[float, ...]:
    swapped = list(values)
    for one, other in pairs:
        if other < len(values):
            swapped[one], swapped[other] = values[other], values[one]
    return tuple(swapped)


def _scaled(deflections: Iterable[float], scale: float) -> Vector3:
    x, y, z = (max(-1.0, min(1.0, scale * one)) for one in deflections)
    return (x, y, z)
