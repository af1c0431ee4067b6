"""In the page's header: whether what is shown can be trusted."""

from __future__ import annotations

from dataclasses import astuple

from protocol.messages import Prediction
from services.bus.predictions import LITTLE
from services.bus.stages import Stages
from services.process.load import Load
from services.station.page.readout import is_stale, length, limited, span
from services.station.page.standing import Standing
from services.station.page.values import Values
from services.station.page.view import Shown
from services.station.words.predictions import certainty
from services.station.words.table import say

FIGURES = (
    *("phase", "age", "latency", "path", "stages", "link", "limited", "object", "model", "prediction", "authority"),
    "network",
)
"""What stands behind the one word of health, in order; the link is measured by the page's script."""

SLOW_S = 0.1
"""From hand to robot, above which a correction comes late."""

OLD_PICTURE_S = 1.0
"""Age above which a camera's picture is marked as old where it is shown, too."""


def health(shown: Shown) -> Values:
    """In a word whether data and links are as they should be: the worst that there is to say."""
    view = shown.view
    recording = view.recording
    latency_s = view.robot.applied_latency if view.robot is not None else 0.0
    pictures_s = max((one.age_s + shown.elapsed_s for one in view.cameras.values() if one is not None), default=0.0)
    if view.robot is None:
        tone, words = "bad", say("health.unheard")
    elif is_stale(shown):
        tone, words = "bad", say("health.stale", age=span(shown.robot_age_s))
    elif shown.load is not None and shown.load.is_too_much:  # most of what is said below comes of it
        tone, words = "warn", busy(shown.load)
    elif view.model is None:
        tone, words = "warn", say("health.model")
    elif pictures_s > OLD_PICTURE_S:
        tone, words = "warn", say("health.pictures", age=span(pictures_s))
    elif latency_s > SLOW_S:
        tone, words = "warn", say("health.slow", age=span(latency_s))
    elif recording is not None and recording.fault:
        tone, words = "warn", say("health.recording")
    else:
        tone, words = "good", say("health.good")
    if view.open_network:  # said for as long as it is so
        tone, words = "warn" if tone == "good" else tone, say("health.open", words=words)
    return {"health@data-tone": tone, "health-text": words}


def busy(load: Load) -> str:
    """That this computer has more to do than it can."""
    wanting = round(load.wanting)
    if load.processors == 1:
        return say("health.busy_one", wanting=wanting)
    return say("health.busy", wanting=wanting, processors=load.processors)


def figures(shown: Shown) -> Values:
    """The figures behind it, who commands aside."""
    view, robot, model, prediction = shown.view, shown.view.robot, shown.view.model, shown.view.prediction
    clamped = limited(shown.clamped)
    return {
        "figure-phase": say("figure.unknown") if robot is None else say(f"robot.{robot.phase.value}"),
        "figure-age": span(shown.robot_age_s),
        "figure-age@data-tone": "bad" if is_stale(shown) else "good",
        "figure-latency": say("figure.none") if robot is None else span(robot.applied_latency),
        "figure-path": _path(view.path),
        "figure-stages": _stages(view.path),
        "figure-limited": clamped or say("figure.nothing"),
        "figure-object": say("figure.unseen") if view.object_pose is None else length(view.object_pose.error),
        "figure-model": say("figure.none")
        if model is None
        else say("figure.version", version=model.version, updates=model.updates),
        "figure-prediction": say("figure.none") if prediction is None else certainty(prediction),
        "figure-prediction@data-tone": _sureness(prediction),
        "figure-network": say("figure.open") if view.open_network else say("figure.closed"),
        "figure-network@data-tone": "warn" if view.open_network else "good",
        "limited": say("pad.limited", what=clamped) if clamped else "",
    }


def _path(path: Stages) -> str:
    """From hand to eye; of what is known no more than that."""
    if not path.known:
        return say("figure.none")
    return span(path.total) if path.complete else say("figure.at_least", least=span(path.total))


def _stages(path: Stages) -> str:
    """The same, stage by stage, as their heading names them [ms]."""
    each = ("?" if value is None else f"{1e3 * value:.0f}" for value in astuple(path))
    return say("duration.milliseconds", number=" + ".join(each)) if path.known else say("figure.none")


def commander(shown: Shown, standing: Standing) -> Values:
    """The last of the figures: who commands, as a tab says it."""
    if shown.view.authority_is_mine and standing.armed:
        return {"figure-authority": say("figure.yours")}
    authority = shown.view.authority
    holder = (authority.operator or authority.holder) if authority is not None else ""
    return {"figure-authority": holder or say("figure.nobody")}


def _sureness(prediction: Prediction | None) -> str:
    """The look of how much is known."""
    if prediction is None:
        return "none"
    return "warn" if prediction.known < LITTLE else "good"
