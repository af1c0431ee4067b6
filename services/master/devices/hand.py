"""What a hand does at one device, whatever the device is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

from protocol.messages import OperatorInput, Vector3
from services.master.devices.device import ZERO


@dataclass(frozen=True)
class Hand:
    """What a hand does at one moment, along and about the axes of its operator: x forward, y left, z up.

    Attributes:
        push: how far it deflects what pushes, each from -1 to 1.
        turn: the same of what turns.
        drag: by how much it has dragged since the look before, in reaches.
        twist: by how much it has twisted since, in reaches.
        held: it holds something that leads the robot.
        grips: it holds what is dragged, which stays where it is then.
        lifted: it does not hold what can be dragged: where the hand leads alone it is decoupled then.
        coupled: the clutch lets it count.
        actions: of the teaching workflow, whose buttons it holds.
    """

    push: Vector3 = ZERO
    turn: Vector3 = ZERO
    drag: Vector3 = ZERO
    twist: Vector3 = ZERO
    held: bool = False
    grips: bool = False
    lifted: bool = False
    coupled: bool = True
    actions: tuple[str, ...] = ()


class Source(Protocol):
    """Devices of one kind."""

    @property
    def kind(self) -> str:
        """Of all of them."""
        ...

    def look(self, operator: OperatorInput) -> Mapping[str, Hand]:
        """What a hand does at each device that is there, by the device's name; called once a step."""
        ...

    def close(self) -> None:
        """Let go of the hardware, where it is read here."""
        ...
