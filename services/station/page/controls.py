"""The page's regions that are pressed: keys, action buttons, emergency stop."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from protocol.keys import PUSH_KEYS, TURN_KEYS, Direction
from protocol.messages import MOST_WAYPOINTS, Light, SafetyState, TeachingState
from services.bus.predictions import LITTLE
from services.station.page.standing import Standing
from services.station.page.values import Values
from services.station.page.view import Shown
from services.station.words.table import say


@dataclass(frozen=True)
class Button:
    """A button of the teaching workflow; its words are in the sections "action" and "hint" of the table.

    Attributes:
        action: its name in `TeachingState.actions`.
        symbol: in assets/symbols.svg.
        place: among the small buttons, from 1, where it stands whatever else is offered; no two that may be offered at
            once have the same.
        confirmed: it takes something away, so that a second press has to confirm it.
        reasoned: it takes something from somebody, who is told the reason, which is asked for before.
    """

    action: str
    symbol: str
    place: int
    confirmed: bool = False
    reasoned: bool = False


BUTTONS = (
    Button("execute", "play", 1),
    Button("refine", "pen", 2),
    Button("lead", "hand", 2),
    Button("store", "place", 4),
    Button("look", "undo", 1),
    Button("put", "place", 1),
    Button("enough", "next", 2, confirmed=True),
    Button("other_place", "next", 3),
    Button("go_on", "next", 5),
    Button("finish", "flag", 6),
    Button("teach", "check", 3),
    Button("next", "place", 4),
    Button("repeat", "undo", 5),
    Button("undo", "undo", 5, confirmed=True),
    Button("end", "end", 6, confirmed=True),
    Button("ask", "hand", 1),
    Button("take_over", "hand", 2, reasoned=True),
)
"""In order."""

_FIRST = ("go_on", "finish", "next", "ask")
"""What is done first where the workflow recommends nothing."""


@dataclass(frozen=True)
class Key:
    """A key that steers.

    Attributes:
        code: its place, as `KeyboardEvent.code` names it.
        cap: what is printed there on a US keyboard; the page's script shows what is printed on this person's.
        axis: of the base frame.
        direction: in which it pushes or turns, as the section "direction" of the table of words names it.
    """

    code: str
    cap: str
    axis: str
    direction: str


def _keyboard(table: Mapping[str, Direction], kind: str) -> tuple[tuple[Key, ...], ...]:
    code_of = {way: code for code, way in table.items()}
    return tuple(tuple(_key(code_of[axis, sign], axis, sign, kind) for axis in range(3)) for sign in (+1, -1))


def _key(code: str, axis: int, sign: int, kind: str) -> Key:
    mark, name = ("+", "plus") if sign > 0 else ("\N{MINUS SIGN}", "minus")
    return Key(code, code[-1], f"{mark}{'xyz'[axis]}", f"{kind}_{'xyz'[axis]}_{name}")


KEYBOARDS = (_keyboard(PUSH_KEYS, "push"), _keyboard(TURN_KEYS, "turn"))
"""Rows of the keys that push, and to their right of those that turn: those along the three axes over those against."""


def actions(shown: Shown) -> Values:
    """What the operator may do now, and the one thing to do first; the rest is not there."""
    teaching = shown.view.teaching
    allowed = frozenset() if teaching is None else frozenset(teaching.actions) - _pointless(teaching)
    first = "" if teaching is None else _first(teaching)
    values: dict[str, str | bool] = {}
    for button in BUTTONS:
        values[f"action-{button.action}@disabled"] = button.action not in allowed
        values[f"action-{button.action}@data-first"] = "yes" if button.action == first else "no"
    guided = teaching is not None and teaching.showing is not None
    values["action-teach-label"] = say("action.keep" if guided else "action.teach")
    values["action-execute-label"] = say("action.replay" if guided else "action.execute")
    values["action-refine-label"] = say("action.show_me" if first == "refine" and _unknown(shown) else "action.refine")
    return values


def _pointless(teaching: TeachingState) -> frozenset[str]:
    """No further waypoint is stored where there are as many as can be; they can be moved all the same."""
    return frozenset({"store"} if len(teaching.waypoints) >= MOST_WAYPOINTS else ())


def _unknown(shown: Shown) -> bool:
    """The place is one of which the model knows little: it asks to be shown."""
    prediction = shown.view.prediction
    return prediction is not None and prediction.known < LITTLE


def _first(teaching: TeachingState) -> str:
    """The button that stands out; none while there is nothing to do but to watch."""
    if teaching.recommended or teaching.light is Light.RED:
        return teaching.recommended
    return next((action for action in _FIRST if action in teaching.actions), "")


def emergency_stop(shown: Shown, standing: Standing) -> Values:
    """The big red button; where a stop was pressed, whether the robot confirms it; who stopped, who released."""
    safety = shown.view.safety
    latched = safety is not None and safety.emergency_stop
    return {
        "stop@data-stop": stop_state(standing.stop_pressed, safety),
        "stop-unconfirmed": say("stop.moving" if latched else "stop.unsaid"),
        "stop-reason": "" if safety is None else _because(safety),
        "stop-reason@data-at": "" if safety is None else safety.at,
        "stop-released": _released(safety),
        "stop-released@data-at": "" if safety is None or not safety.released_by else safety.at,
    }


def _released(safety: SafetyState | None) -> str:
    if safety is None or not safety.released_by:
        return ""
    return say("stop.released_earlier" if safety.earlier else "stop.released", name=safety.released_by)


def is_confirmed(safety: SafetyState | None) -> bool:
    """Whether the robot says that it is stopped, and was measured to stand."""
    return safety is not None and safety.emergency_stop and safety.standing


def stop_state(pressed: bool, safety: SafetyState | None) -> str:
    """How a stop stands: ready, unconfirmed, moving where it is latched and the arm does not stand yet, stopped."""
    if is_confirmed(safety):
        return "stopped"
    if safety is not None and safety.emergency_stop:
        return "moving"
    return "unconfirmed" if pressed else "ready"


def _because(safety: SafetyState) -> str:
    if not safety.reason:
        return safety.by
    return say("stop.reason", name=safety.by or say("stop.somebody"), reason=safety.reason)
