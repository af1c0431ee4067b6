"""The page's regions that are pressed: keys, action buttons, emergency stop."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from protocol.keys import PUSH_KEYS, TURN_KEYS, Direction
from protocol.messages import SafetyState
from services.station.page.standing import Standing
from services.station.page.values import Values
from services.station.page.view import Shown


@dataclass(frozen=True)
class Button:
    """A button of the teaching workflow.

    Attributes:
        action: its name in `TeachingState.actions`.
        label: what a person reads.
        hint: what it does.
        symbol: in assets/symbols.svg.
        question: that is answered with a reason before it is pressed; empty where none is needed.
    """

    action: str
    label: str
    hint: str
    symbol: str
    question: str = ""


BUTTONS = (
    Button("execute", "Execute", "the robot alone", "play"),
    Button("refine", "Refine", "you correct it", "pen"),
    Button("go_on", "Go on", "with this motion", "next"),
    Button("finish", "Finish", "Space", "flag"),
    Button("teach", "Teach this", "what you showed", "check"),
    Button("next", "Next object", "a new place", "place"),
    Button("undo", "Undo", "the last update", "undo"),
    Button("end", "End", "this run", "end"),
    Button("ask", "Ask", "for the robot", "hand"),
    Button("take_over", "Take over", "and say why", "hand", "Why do you take the robot over?"),
)
"""In order; those for the authority are there only while somebody else may have it."""


@dataclass(frozen=True)
class Key:
    """A key that steers.

    Attributes:
        code: its place, as `KeyboardEvent.code` names it.
        cap: what is printed there on a US keyboard; the page's script shows what is printed on this person's.
        axis: of the base frame.
        direction: in which it pushes or turns.
    """

    code: str
    cap: str
    axis: str
    direction: str


_PUSHES = (("forward", "left", "up"), ("back", "right", "down"))
_TURNS = (("roll right", "tilt down", "turn left"), ("roll left", "tilt up", "turn right"))
"""Directions along the three axes, then against them: as the keys lie under the hand."""


def _keyboard(table: Mapping[str, Direction], directions: tuple[tuple[str, ...], ...]) -> tuple[tuple[Key, ...], ...]:
    code_of = {way: code for code, way in table.items()}
    return tuple(
        tuple(_key(code_of[axis, sign], axis, sign, direction) for axis, direction in enumerate(row))
        for sign, row in zip((+1, -1), directions, strict=True)
    )


def _key(code: str, axis: int, sign: int, direction: str) -> Key:
    return Key(code, code[-1], ("+" if sign > 0 else "\N{MINUS SIGN}") + "xyz"[axis], direction)


KEYBOARDS = (_keyboard(PUSH_KEYS, _PUSHES), _keyboard(TURN_KEYS, _TURNS))
"""Rows of the keys that push, and to their right of those that turn."""


def actions(shown: Shown) -> Values:
    """What the operator may do now, and what is recommended; the rest is there and cannot be pressed."""
    teaching = shown.view.teaching
    allowed = frozenset() if teaching is None else frozenset(teaching.actions)
    first = "" if teaching is None else teaching.recommended
    values: dict[str, str | bool] = {}
    for button in BUTTONS:
        values[f"action-{button.action}@disabled"] = button.action not in allowed
        values[f"action-{button.action}@data-first"] = "yes" if button.action == first else "no"
    return values


def emergency_stop(shown: Shown, standing: Standing) -> Values:
    """The big red button; where a stop was pressed, whether the robot confirms it; who stopped, who released."""
    safety = shown.view.safety
    latched = safety is not None and safety.emergency_stop
    return {
        "stop@data-stop": _stop(standing.stop_pressed, safety),
        "stop-unconfirmed": "It is latched, but the arm still moves." if latched else "The robot has not said so yet.",
        "stop-reason": "" if safety is None else _because(safety),
        "stop-reason@data-at": "" if safety is None else safety.at,
        "stop-released": "" if safety is None or not safety.released_by else f"released by {safety.released_by}",
        "stop-released@data-at": "" if safety is None or not safety.released_by else safety.at,
    }


def is_confirmed(safety: SafetyState | None) -> bool:
    """Whether the robot says that it is stopped, and was measured to stand."""
    return safety is not None and safety.emergency_stop and safety.standing


def _stop(pressed: bool, safety: SafetyState | None) -> str:
    if is_confirmed(safety):
        return "stopped"
    if safety is not None and safety.emergency_stop:
        return "moving"
    return "unconfirmed" if pressed else "ready"


def _because(safety: SafetyState) -> str:
    return ": ".join(part for part in (safety.by, safety.reason) if part)
