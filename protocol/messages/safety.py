"""What keeps the robot from moving: the class `safety`."""

from __future__ import annotations

from protocol.messages.values import Message, Name, Real, Text


class EmergencyStop(Message, frozen=True, kw_only=True):
    """Pressed: every robot process that hears it latches a stop. Repeated while pressed."""

    pressed: bool
    by: Name
    reason: Text = ""


class SafetyState(Message, frozen=True, kw_only=True):
    """What keeps the robot from moving, as measured.

    Attributes:
        emergency_stop: latched; release and a new authority are needed to move again.
        by: who pressed it.
        reason: for people.
        at: when it was latched, or released where it is not: UTC by the robot's clock, ISO 8601; empty for never.
        released_by: who released it last; empty while it is latched, or for never.
        earlier: the newest press and release were before the robot's process began.
        standing: every joint was measured to stand still.
        self_distance: least distance between parts of the robot [m].
        backend: what moves is "ready", "holding", in "protective stop" or "hardware stop", in the "wrong mode", or "not
            connected"; empty where it does not say.
        backend_age: of what that was measured from [s].
    """

    emergency_stop: bool
    by: Name = ""
    reason: Text = ""
    at: Name = ""
    released_by: Name = ""
    earlier: bool = False
    standing: bool = False
    self_distance: Real = 0.0
    backend: Name = ""
    backend_age: Real = 0.0
