"""The motion as a bar: how far it is, which part of it is corrected, how fast it goes, and where it was spoilt."""

from __future__ import annotations

from protocol.messages import Part
from services.station.page.values import Values
from services.station.page.view import Shown
from services.station.words.table import say

CONTROLS = ("step_back", "pause", "play", "step_on", "pace", "seek", "part")
"""What is pressed, slid or dragged on it, by the names in `TeachingState.actions`."""


def timeline(shown: Shown) -> Values:
    """Everything that the bar and its controls show; how far the motion is that runs, or ran last."""
    teaching, robot, spoilt = shown.view.teaching, shown.view.robot, shown.view.spoilt
    allowed = frozenset() if teaching is None else frozenset(teaching.actions)
    pace, part = (1.0, Part()) if teaching is None else (teaching.pace, teaching.part)
    progress = 0.0 if robot is None else min(max(robot.progress, 0.0), 1.0)
    going = _going(shown)
    return {
        **{f"action-{name}@disabled": name not in allowed for name in CONTROLS},
        "timeline@data-going": going,
        "timeline@data-pace": f"{pace:.2f}",
        "timeline@data-first": f"{part.first:.3f}",
        "timeline@data-last": f"{part.last:.3f}",
        "timeline@data-progress": f"{progress:.3f}",
        "timeline@data-spoilt": " ".join(f"{share:.3f}" for share in spoilt),
        "timeline-done@--done": f"{progress:.3f}",
        "timeline-done@aria-valuenow": _percent(progress),
        "timeline-text": _words(going, progress, part),
        "timeline-pace": say("timeline.pace_text", share=_percent(pace)),
    }


def _going(shown: Shown) -> str:
    """The look of the motion: none where there is none."""
    execution = shown.view.execution
    if execution is None:
        return "none"
    if execution.pace == 0.0:
        return "paused"
    return "back" if execution.pace < 0.0 else "on"


def _words(going: str, progress: float, part: Part) -> str:
    where = say(f"timeline.{going}" if going in ("paused", "back") else "timeline.done", share=_percent(progress))
    if part == Part():
        return where
    return f"{where}; {say('timeline.part', first=_percent(part.first), last=_percent(part.last))}"


def _percent(share: float) -> str:
    return f"{100.0 * share:.0f}"
