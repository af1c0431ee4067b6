"""The method's region: by which method is taught, what a refinement starts from, and the waypoints that are stored."""

from __future__ import annotations

from protocol.messages import Method, Origin, TeachingState, Waypoint
from services.station.page.values import Values
from services.station.page.view import Shown
from services.station.words.table import say

METHODS = (Method.REFINE, Method.WAYPOINTS, Method.DEMONSTRATE)
BASES = (Origin.MODEL, Origin.REFINEMENT)
"""Their words are in the sections "method" and "basis"."""

EDITS = ("store", "earlier", "later", "delete")
"""What can be done with one waypoint, as the workflow calls it."""

CONTROLS = ("method", "basis", "clear", *EDITS)
"""What is pressed here, by the names in `TeachingState.actions`."""


def methods(shown: Shown) -> Values:
    """Everything that the region shows."""
    teaching = shown.view.teaching
    if teaching is None:
        return {}
    allowed = frozenset(teaching.actions)
    empty = teaching.showing is not None or (shown.view.model is not None and shown.view.model.empty)
    returns = teaching.method is Method.REFINE
    return {
        "method": say(f"method.{teaching.method.value}"),
        "methods@data-method": teaching.method.value,
        "methods@data-based": "yes" if "basis" in allowed else "no",
        **_chosen("method", [one.value for one in METHODS], teaching.method.value, open_="method" in allowed),
        "method-refine@disabled": empty or "method" not in allowed,
        "method-refine@title": say("method.unusable") if empty else "",
        "keyboard-help": say("pad.keyboard_help" if returns else "pad.keyboard_help_led"),
        "pointer-help": say("pad.pointer_help" if returns else "pad.pointer_help_led"),
        **_chosen("basis", [one.value for one in BASES], teaching.basis.value, open_="basis" in allowed),
        "action-clear@disabled": "clear" not in allowed,
        "waypoints@data-places": ";".join(_place(waypoint) for waypoint in teaching.waypoints),
        "waypoints@data-edits": " ".join(name for name in EDITS if name in allowed),
        "waypoints-count": _count(teaching),
    }


def _chosen(kind: str, names: list[str], chosen: str, *, open_: bool) -> dict[str, str | bool]:
    values: dict[str, str | bool] = {}
    for name in names:
        values[f"{kind}-{name}@aria-pressed"] = "true" if name == chosen else "false"
        values[f"{kind}-{name}@disabled"] = not open_
    return values


def _place(waypoint: Waypoint) -> str:
    """Where it is [cm] and, where the gripper takes part, how far that is open from there on [mm]."""
    opening = () if waypoint.opening is None else (1e3 * waypoint.opening,)
    return " ".join(f"{value:.0f}" for value in (*(100.0 * value for value in waypoint.position), *opening))


def _count(teaching: TeachingState) -> str:
    return say("waypoints.count", count=len(teaching.waypoints))
