"""The motion as a bar: how far it is, which part of it is corrected, how fast it goes, and where it was spoilt."""

from __future__ import annotations

from services.station.page.values import Values
from services.station.page.view import Shown

CONTROLS = ("step_back", "pause", "play", "step_on", "pace", "seek", "part")
"""What is pressed, slid or dragged on it, by the names in `TeachingState.actions`."""


def timeline(shown: Shown) -> Values:
    """Everything that the bar and its controls show."""
    teaching, execution, robot = shown.view.teaching, shown.view.execution, shown.view.robot
    if teaching is None:
        return {}
    allowed = frozenset(teaching.actions)
    progress = 0.0 if execution is None or robot is None else robot.progress
    return {
        **{f"action-{name}@disabled": name not in allowed for name in CONTROLS},
        "timeline@data-going": _going(shown),
        "timeline@data-pace": f"{teaching.pace:.2f}",
        "timeline@data-first": f"{teaching.part.first:.3f}",
        "timeline@data-last": f"{teaching.part.last:.3f}",
        "timeline@data-progress": f"{progress:.3f}",
        "timeline@data-spoilt": " ".join(f"{share:.3f}" for share in shown.view.spoilt),
    }


def _going(shown: Shown) -> str:
    """The look of the motion: none where there is none."""
    execution = shown.view.execution
    if execution is None:
        return "none"
    if execution.pace == 0.0:
        return "paused"
    return "back" if execution.pace < 0.0 else "on"
