"""The page's regions that tell: header, live view, traffic light, counters, verdict."""

from __future__ import annotations

from protocol.messages import Light, Prediction
from services.bus.predictions import LITTLE, certainty
from services.station.page.readout import LIGHT_WORDS, criteria, is_stale, length, outcome, span, tone
from services.station.page.standing import Standing
from services.station.page.values import Values
from services.station.page.view import Shown

CHIPS = (
    ("phase", "Robot"),
    ("age", "Data age"),
    ("latency", "Hand to robot"),
    ("object", "Object error"),
    ("model", "Model"),
    ("prediction", "Prediction"),
    ("authority", "Authority"),
)
"""Figures in the header: name and title."""

COUNTERS = (("refinements", "Refinements"), ("updates", "Updates"))
CRITERIA = (("reached", "Target reached"), ("kicked", "Not kicked over"), ("collision", "No collision"))
"""The success criteria, each with a check or a cross and its evidence."""


def header(shown: Shown) -> Values:
    """The figures."""
    view, robot, model, prediction = shown.view, shown.view.robot, shown.view.model, shown.view.prediction
    return {
        "chip-phase-text": "unknown" if robot is None else robot.phase.value,
        "chip-age-text": span(shown.robot_age_s),
        "chip-age@data-tone": "bad" if is_stale(shown) else "good",
        "chip-latency-text": " / ".join(span(figure.value) for figure in view.latencies) or "none",
        "chip-object-text": "not seen" if view.object_pose is None else length(view.object_pose.error),
        "chip-model-text": "none" if model is None else f"v{model.version}, {model.updates} learnt",
        "chip-prediction-text": "none" if prediction is None else certainty(prediction),
        "chip-prediction@data-tone": _sureness(prediction),
    }


def _sureness(prediction: Prediction | None) -> str:
    """The look of how much is known."""
    if prediction is None:
        return "none"
    return "warn" if prediction.known < LITTLE else "good"


def scene(shown: Shown) -> Values:
    """Where all there is can be inspected, and whether the data is old."""
    recording, stale = shown.view.recording, is_stale(shown)
    never = shown.view.robot is None
    age = "has not come yet" if never else f"is {span(shown.robot_age_s)} old"
    return {
        "inspect@data-address": "" if recording is None else recording.viewer_url,
        "scene@data-stale": "yes" if stale else "no",
        "recording-fault": "" if recording is None else recording.fault,
        "stale": f"Robot data {age}" if stale else "",
    }


def traffic_light(shown: Shown, standing: Standing) -> Values:
    """May the operator act? Said by colour, shape and word; below it what to do.

    Where this tab's keys do not count the workflow's green is not for it.
    """
    teaching = shown.view.teaching
    if teaching is None:
        waiting = "Waiting for the teaching workflow."
        return {"light@data-light": "off", "light-word": "Starting", "light-text": waiting, "notice": ""}
    light, words = teaching.light, teaching.text or teaching.reason
    stopped = shown.view.safety is not None and shown.view.safety.emergency_stop
    if light is Light.GREEN and not standing.armed:
        light, words = Light.RED, "Whoever has the input acts."
    elif light is Light.GREEN and teaching.phase == "executing" and standing.let_go:
        light, words = Light.HOLD, "Your keys do not count yet."
    return {
        "light@data-light": light.value,
        "light-word": "Stopped" if stopped else LIGHT_WORDS[light],
        "light-text": words,
        "notice": shown.view.notice,
    }


def counters(shown: Shown) -> Values:
    """How many refinements and updates are used."""
    teaching = shown.view.teaching
    if teaching is None:
        return {}
    return {
        "refinements": f"{teaching.refinements} / {teaching.refinements_allowed}",
        "refinements-bar@--used": str(teaching.refinements),
        "refinements-bar@--allowed": str(max(teaching.refinements_allowed, 1)),
        "updates": f"{teaching.updates} / {teaching.updates_allowed}",
        "updates-bar@--used": str(teaching.updates),
        "updates-bar@--allowed": str(max(teaching.updates_allowed, 1)),
    }


def verdict(shown: Shown) -> Values:
    """The success criteria as they are now."""
    good, word = outcome(shown)
    values: dict[str, str | bool] = {"verdict@data-tone": tone(good), "outcome": word}
    for (name, _), (met, evidence) in zip(CRITERIA, criteria(shown), strict=True):
        values[f"{name}@data-tone"] = tone(met)
        values[f"{name}-evidence"] = evidence
    return values
