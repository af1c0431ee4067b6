"""What was measured, as a person reads it on the page: pure functions."""

from __future__ import annotations

import math

from protocol.messages import Verdict
from services.station.page.view import Shown
from services.station.words.heard import heard
from services.station.words.table import say, speech

STALE_AFTER_S = 0.3
"""Age of the robot's state above which the page says so in red."""


def span(seconds: float) -> str:
    """A time span in three characters and a unit; "none" where it is not finite or negative."""
    if not math.isfinite(seconds) or seconds < 0.0:
        return say("duration.none")
    if seconds < 0.9995:
        return say("duration.milliseconds", number=f"{seconds * 1e3:.0f}")
    if seconds < 60.0:
        return say("duration.seconds", number=f"{seconds:.1f}")
    return say("duration.minutes", number=f"{seconds / 60.0:.0f}")


def length(metres: float) -> str:
    """A distance in millimetres; "none" where it is negative, which means that it is not known."""
    return say("length.millimetres", number=f"{metres * 1e3:.0f}") if metres >= 0.0 else say("length.none")


def limited(clamped: tuple[str, ...]) -> str:
    """What the robot limits; empty where it limits nothing."""
    return ", ".join(dict.fromkeys(_limit(what) for what in clamped))


def _limit(what: str) -> str:
    kind, _, place = what.partition(" ")
    kind, known = kind.rstrip(":"), speech.section("limit")
    if kind not in known or kind == "other":
        return say("limit.other", what=what)
    return known[kind].format(place=heard(place))


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
    return (
        (True if verdict.reached else _open_while_moving(shown), _miss(verdict)),
        (not verdict.kicked_over, _moved(verdict)),
        (not verdict.collision, _contact(verdict)),
    )


def outcome(shown: Shown) -> tuple[bool | None, str]:
    """All three criteria in a word; none of a motion that was only led to store waypoints."""
    if _was_led(shown):
        return None, say("verdict.led")
    met = [good for good, _ in criteria(shown)]
    if False in met:
        return False, say("verdict.failure")
    if shown.view.verdict is None or not _has_moved(shown):
        return None, say("verdict.none")
    return (True, say("verdict.success")) if None not in met else (None, say("verdict.under_way"))


def _open_while_moving(shown: Shown) -> bool | None:
    robot = shown.view.robot
    running = robot is not None and robot.phase.running
    return None if running or _was_led(shown) or not _has_moved(shown) else False


def _was_led(shown: Shown) -> bool:
    return shown.view.teaching is not None and shown.view.teaching.led


def _has_moved(shown: Shown) -> bool:
    """An episode has begun since the robot's process did; before the first there is nothing to judge."""
    robot = shown.view.robot
    return robot is None or robot.episode > 0


def _miss(verdict: Verdict) -> str:
    """How far off the target is, and what else the task asks for that is not so."""
    far = [say("verdict.missed", distance=length(verdict.missed))] if verdict.missed >= 0.0 else []
    return say("verdict.also").join([*far, *(say(f"verdict.not_{unmet.value}") for unmet in verdict.unmet)])


def _moved(verdict: Verdict) -> str:
    moved = max(abs(d) for d in verdict.object_displacement)
    return say("verdict.moved", distance=length(moved), angle=f"{math.degrees(verdict.object_tilt):.0f}")


def _contact(verdict: Verdict) -> str:
    if not verdict.collision:
        return say("verdict.untouched")
    force = f"{verdict.collision_force:.1f}"
    if verdict.collision_position is None:
        return say("verdict.force", force=force)
    x, y, z = (f"{c * 1e3:.0f}".replace("-", "\N{MINUS SIGN}") for c in verdict.collision_position)
    return say("verdict.force_at", force=force, x=x, y=y, z=z)
