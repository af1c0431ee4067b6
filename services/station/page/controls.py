"""The page's regions that are pressed: keys, action buttons, emergency stop."""

from __future__ import annotations

from dataclasses import dataclass

from nicegui.element import Element

from services.station.page.elements import block, enable, icon, mark, text
from services.station.page.view import Shown


@dataclass(frozen=True)
class Button:
    """A button of the teaching workflow.

    Attributes:
        action: its name in `TeachingState.actions`.
        label: what a person reads.
        hint: what it does.
        symbol: in assets/symbols.svg.
    """

    action: str
    label: str
    hint: str
    symbol: str


BUTTONS = (
    Button("execute", "Execute", "the robot alone", "play"),
    Button("refine", "Refine", "you correct it", "pen"),
    Button("finish", "Finish", "Space", "flag"),
    Button("next", "Next object", "a new place", "next"),
    Button("undo", "Undo", "the last update", "undo"),
    Button("end", "End", "this run", "end"),
    Button("take_over", "Take over", "the authority", "hand"),
)

MINUS = "\N{MINUS SIGN}"

PUSH_KEYS = (
    (("KeyQ", "Q", "+x", "forward"), ("KeyW", "W", "+y", "left"), ("KeyE", "E", "+z", "up")),
    (("KeyA", "A", f"{MINUS}x", "back"), ("KeyS", "S", f"{MINUS}y", "right"), ("KeyD", "D", f"{MINUS}z", "down")),
)
"""Rows of keys as they lie under the hand: code, cap, axis of the base frame, direction."""

TURN_KEYS = (
    (("KeyR", "R", "+x", "roll right"), ("KeyT", "T", "+y", "tilt down"), ("KeyY", "Y", "+z", "turn left")),
    (
        ("KeyF", "F", f"{MINUS}x", "roll left"),
        ("KeyG", "G", f"{MINUS}y", "tilt up"),
        ("KeyH", "H", f"{MINUS}z", "turn right"),
    ),
)
"""The same of the keys to their right, which rotate about the axis."""


def keys() -> None:
    """The keys and what they do; the page's script lights those that are held."""
    with block("panel keys"):
        with block("keyboards"):
            for rows in (PUSH_KEYS, TURN_KEYS):
                _keyboard(rows)
        text("Hold a key to push or turn the gripper; let go to return.", "keys-help")
        text("Let go of everything to use the keys again.", "keys-let-go")


def _keyboard(rows: tuple[tuple[tuple[str, str, str, str], ...], ...]) -> None:
    with block("keyboard"):
        for code, cap, axis, direction in (key for row in rows for key in row):
            with block("key").props(f"data-key={code}"):
                text(cap, "key-cap")
                text(axis, "key-axis")
                text(direction, "key-direction")


class Actions:
    """What the operator may do now; the rest is there and cannot be pressed."""

    def __init__(self) -> None:
        with block("panel actions"):
            self._buttons = {button.action: self._button(button) for button in BUTTONS}

    @staticmethod
    def _button(button: Button) -> Element:
        with block("action", "button").props(f"type=button data-action={button.action}") as element:
            icon(button.symbol)
            text(button.label, "action-label")
            text(button.hint, "action-hint")
        enable(element, False)
        return element

    def update(self, shown: Shown) -> None:
        """Follow the teaching state."""
        teaching = shown.view.teaching
        allowed = frozenset() if teaching is None else frozenset(teaching.actions)
        for action, element in self._buttons.items():
            enable(element, action in allowed)


class EmergencyStop:
    """The big red button; where the stop is latched, who pressed it, and its release."""

    def __init__(self) -> None:
        with block("stop") as self._box:
            with block("stop-button", "button").props("type=button data-action=stop"):
                icon("stop")
                text("Emergency stop", "stop-label")
                text("Escape", "stop-hint")
            with block("stopped"):
                with block("stopped-words"):
                    text("Stopped", "stopped-title")
                    self._reason = text("", "stopped-reason")
                with block("release", "button").props("type=button data-action=release_stop"):
                    text("Release", "release-label")

    def update(self, shown: Shown) -> None:
        """Show whether the stop is latched."""
        safety = shown.view.safety
        latched = safety is not None and safety.emergency_stop
        mark(self._box, "data-stopped", "yes" if latched else "no")
        if safety is not None and latched:
            self._reason.set_text(": ".join(part for part in (safety.by, safety.reason) if part))
