"""The page's regions that tell: live view, traffic light, counters, verdict."""

from __future__ import annotations

from protocol.messages import Light, Mode, Origin, Role
from services.station.page.readout import criteria, is_stale, outcome, span, tone
from services.station.page.standing import Standing
from services.station.page.values import Values
from services.station.page.view import Picture, Shown
from services.station.words.heard import heard
from services.station.words.table import say

COUNTERS = ("refinements", "updates")
CRITERIA = ("reached", "kicked", "collision")
"""The success criteria, each with a check or a cross and its evidence."""


def scene(shown: Shown) -> Values:
    """Where all there is can be inspected, who shaped the ways that are seen, and whether the data is old."""
    recording, stale = shown.view.recording, is_stale(shown)
    never = shown.view.robot is None
    way = Mode.AUTONOMOUS if shown.view.robot is None else shown.view.robot.mode
    age = say("scene.never") if never else say("scene.stale", age=span(shown.robot_age_s))
    curve = shown.view.drawing.prediction
    origin = Origin.MODEL if curve is None else curve.origin
    return {
        "inspect@data-address": "" if recording is None else recording.viewer_url,
        "scene@data-stale": "yes" if stale else "no",
        "scene@data-way": way.value,
        "legend-way": say(f"scene.way_{way.value}"),
        "scene@data-origin": origin.value,
        "scene@data-kick": "no" if shown.view.drawing.kick.stood is None else "yes",
        "legend-predicted": say(f"scene.from_{origin.value}"),
        **{f"camera-{name}@data-yaw": _told(picture) for name, picture in shown.view.cameras.items()},
        "recording-fault": "" if recording is None else heard(recording.fault),
        "stale": age if stale else "",
    }


def _told(picture: Picture | None) -> str:
    return "0" if picture is None else f"{picture.yaw:.2f}"


def traffic_light(shown: Shown, standing: Standing) -> Values:
    """May the operator act? Said by colour, shape and word; below it what to do.

    Where this tab's keys do not count the workflow's green is not for it.
    """
    teaching = shown.view.teaching
    if teaching is None:
        starting = {"light-word": say("light.off"), "light-text": say("light.starting")}
        return {"light@data-light": "off", **starting, "notice": ""}
    light, words = teaching.light, teaching.text or teaching.reason
    stopped = shown.view.safety is not None and shown.view.safety.emergency_stop
    waits = teaching.phase == "waiting" and words == say("waiting.operator")
    if standing.vacant and (waits or light is Light.GREEN):
        light = Light.RED if light is Light.GREEN else light
        words = say("light.vacant_operator" if standing.identity.role is Role.OPERATOR else "light.vacant")
    elif light is Light.GREEN and not standing.armed:
        light, words = Light.RED, say("light.other")
    elif light is Light.GREEN and teaching.phase == "executing" and standing.let_go:
        light, words = Light.HOLD, say("light.let_go")
    return {
        "light@data-light": light.value,
        "light-word": say("light.stopped" if stopped else f"light.{light.value}"),
        "light-text": words,
        "notice": " ".join(part for part in (teaching.event, shown.view.notice) if part),
    }


def counters(shown: Shown) -> Values:
    """How many refinements and updates are used."""
    teaching = shown.view.teaching
    if teaching is None:
        return {}
    used = {
        "refinements": (teaching.refinements, teaching.refinements_allowed),
        "updates": (teaching.updates, teaching.updates_allowed),
    }
    values: dict[str, str | bool] = {}
    for name in COUNTERS:
        now, most = used[name]
        values[name] = say("history.count", used=now, allowed=most)
        values[f"{name}-bar@--used"] = str(now)
        values[f"{name}-bar@--allowed"] = str(max(most, 1))
    return values


def verdict(shown: Shown) -> Values:
    """The success criteria as they are now."""
    good, word = outcome(shown)
    values: dict[str, str | bool] = {"verdict@data-tone": tone(good), "outcome": word}
    for name, (met, evidence) in zip(CRITERIA, criteria(shown), strict=True):
        values[f"{name}@data-tone"] = tone(met)
        values[f"{name}-evidence"] = evidence
    return values
