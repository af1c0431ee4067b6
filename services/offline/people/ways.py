"""The ways in which a person teaches, and what they lead by."""

from __future__ import annotations

from enum import Enum

from protocol.messages import Method


class Teaching(Enum):
    """How they teach: by one of two refinements, or one of the two ways offline."""

    PREDICTION = "prediction"
    REFINEMENT = "refinement"
    WAYPOINTS = "waypoints"
    DEMONSTRATION = "demonstration"

    @property
    def method(self) -> Method:
        """As the page calls it."""
        match self:
            case Teaching.WAYPOINTS:
                return Method.WAYPOINTS
            case Teaching.DEMONSTRATION:
                return Method.DEMONSTRATE
            case _:
                return Method.REFINE


class Device(Enum):
    """What a person leads by."""

    STYLUS = "stylus"
    KEYBOARD = "keyboard"
    GAMEPAD = "gamepad"
    SPACE_MOUSE = "spacemouse"
    POINTER = "pointer"
