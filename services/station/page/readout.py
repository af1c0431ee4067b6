"""What was measured, as a person reads it on the page: pure functions."""

from __future__ import annotations

import math

from protocol.messages import Light, Verdict
from services.station.page.view import Shown

STALE_AFTER_S = 0.3
"""Age of the robot's state above which the page says so in red."""

LIGHT_WORDS = {Light.RED: "Watch", Light.AMBER: "Wait", Light.HOLD: "Hold", Light.GREEN: "Act"}


def span(seconds: float) -> str:
    """A time span in three characters and a unit; "none" where it is not finite or negative."""
    if not math.isfinite(seconds) or seconds < 0.0:
        return "none"
    if seconds < 0.9995:
        return f"{seconds * 1e3:.0f} ms"
    if seconds < 60.0:
        return f"{seconds:.1f} s"
    return f"{seconds / 60.0:.0f} min"


def length(metres: float) -> str:
    """A distance in millimetres; "none" where it is negative, which means that it is not known."""
    return f"{metres * 1e3:.0f} mm" if metres >= 0.0 else "none"


def is_stale(shown: Shown) -> bool:
    """Whether the robot's state is too old to act upon."""
    return not shown.robot_age_s <= STALE_AFTER_S


def tone(good: bool | None) -> str:
    """The name of a criterion's look."""
    return {True: "good", False: "bad", None: "none"}[good]


def criteria(shown: Shown) -> tuple[tuple[bool | None, str], ...]:
    """The three success criteria: met, failed or not yet known, and the evidence."""
    verdict = shown.view.verdict
    if verdict is None:
        return ((None, ""),) * 3
    moved = max(abs(d) for d in verdict.object_displacement)
    return (
        (True if verdict.reached else _open_while_moving(shown), _miss(verdict)),
        (not verdict.kicked_over, f"moved {length(moved)}, tilted {math.degrees(verdict.object_tilt):.0f}°"),
        (not verdict.collision, _contact(verdict)),
    )


def outcome(shown: Shown) -> tuple[bool | None, str]:
    """All three criteria in a word."""
    met = [good for good, _ in criteria(shown)]
    if False in met:
        return False, "Failure"
    if shown.view.verdict is None or not _has_moved(shown):
        return None, "No verdict yet"
    return (True, "Success") if None not in met else (None, "Under way")


def _open_while_moving(shown: Shown) -> bool | None:
    robot = shown.view.robot
    return None if (robot is not None and robot.phase.running) or not _has_moved(shown) else False


def _has_moved(shown: Shown) -> bool:
    """An episode has begun since the robot's process did; before the first there is nothing to judge."""
    robot = shown.view.robot
    return robot is None or robot.episode > 0


def _miss(verdict: Verdict) -> str:
    return f"{length(verdict.missed)} from the target" if verdict.missed >= 0.0 else ""


def _contact(verdict: Verdict) -> str:
    if not verdict.collision:
        return "no contact"
    if verdict.collision_position is None:
        return f"{verdict.collision_force:.1f} N"
    place = ", ".join(f"{c:.2f}" for c in verdict.collision_position)
    return f"{verdict.collision_force:.1f} N at {place}\N{NO-BREAK SPACE}m"
