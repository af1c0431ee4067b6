"""The main states of the page, each by a name: what is tested in all of them, and what the documentation shows."""

from dataclasses import replace

import msgspec
from harness import working_view

from protocol import messages
from protocol.messages import Light, Method, Phase, SafetyState, Showing, ShowStep
from protocol.queries import HistoryListed
from services.station.page.entries import rows_of

SENTENCES = {
    "untaught": "I have learnt nothing yet: show me. First put the object 86 cm ahead and 6 cm right, or take another"
    " place.",
    "ready": "Ready. Watch what the robot does alone.",
    "alone": "The robot moves alone.",
    "failed": "The robot touched something, missed the target by 84 mm. Correct it.",
    "correcting": "Steer around it. Space when done.",
    "paused": "This page was not in view, or did not answer. Press Go on, or Done.",
    "done": "Reached, nothing touched. Teach it?",
    "learning": "The robot learns what you showed.",
    "watching": "bert commands the robot. Ask, or take over.",
    "stopped": "Emergency stop by anna: release it to go on.",
    "finished": "Finished: the robot has learnt from the correction. Press Next object to begin again.",
}
NOTHING = rows_of(HistoryListed(0, (), 0))
TO_PUT = ("end", "method", "other_place", "put")
IN_HAND = ("end", "execute", "next", "refine", "undo")


def states():
    """Views by name."""
    missed = {"reached": False, "kicked_over": False, "missed": 0.084}
    touched = {"collision": True, "collision_position": (0.55, -0.12, 0.56), "collision_force": 12.4}
    reached = {"reached": True, "kicked_over": False, "collision": False, "missed": 0.006}
    taught = (*IN_HAND, "teach")
    return {
        "untaught": _untaught(_view("untaught", "deciding", Light.GREEN, TO_PUT, "put", progress=0.0, episode=0)),
        "ready": _view("ready", "deciding", Light.GREEN, IN_HAND, "execute", episode=0),
        "alone": _view("alone", "executing", Light.RED, ("finish",), phase=Phase.EXECUTE),
        "failed": _view("failed", "deciding", Light.GREEN, IN_HAND, "refine", progress=1.0, verdict=missed | touched),
        "correcting": _view("correcting", "executing", Light.GREEN, ("finish",), phase=Phase.EXECUTE),
        "paused": _view("paused", "executing", Light.HOLD, ("finish", "go_on"), phase=Phase.HOLD),
        "done": _view("done", "deciding", Light.GREEN, taught, "teach", progress=1.0, verdict=reached),
        "learning": _view("learning", "learning", Light.AMBER, (), progress=1.0, verdict=reached),
        "watching": _of_bert(_view("watching", "watching", Light.AMBER, ("ask", "take_over"))),
        "stopped": _stopped(_view("stopped", "stopped", Light.RED, ("release_stop",), phase=Phase.STOPPED)),
        "finished": _view("finished", "finished", Light.GREEN, ("next",), progress=1.0, verdict=reached),
        "stale": replace(_view("alone", "executing", Light.RED, ("finish",), phase=Phase.EXECUTE), robot_age_s=1.4),
        "nothing": type(working_view())(),
    }


def _view(name, phase_name, light, actions, recommended="", *, phase=Phase.IDLE, progress=0.4, verdict=None, episode=3):
    view = working_view()
    teaching = {"phase": phase_name, "text": SENTENCES[name], "light": light, "actions": actions}
    judged = verdict or {"reached": False, "kicked_over": False, "collision": False, "missed": 0.084}
    return replace(
        view,
        teaching=msgspec.structs.replace(view.teaching, recommended=recommended, **teaching),
        robot=msgspec.structs.replace(view.robot, phase=phase, progress=progress, episode=episode),
        verdict=msgspec.structs.replace(view.verdict, **judged),
    )


def _untaught(view):
    """Before anything was shown, learnt or judged."""
    empty = msgspec.structs.replace(view.model, version=0, demonstrations=0, updates=0)
    shown = msgspec.structs.replace(
        view.teaching,
        method=Method.WAYPOINTS,
        showing=Showing(ShowStep.PLACE, 1, 2),
        refinements=0,
        updates=0,
    )
    drawing = msgspec.structs.replace(view.drawing, prediction=None, way=())
    return replace(view, teaching=shown, model=empty, prediction=None, history=NOTHING, drawing=drawing)


def _of_bert(view):
    authority = messages.AuthorityState(holder="station-2", operator="bert", epoch=5, expires_in=0.9)
    return replace(view, authority=authority, authority_is_mine=False)


def _stopped(view):
    stop = SafetyState(
        emergency_stop=True, by="anna", reason="pressed on the page", standing=True, at="2026-11-25T10:00:05Z"
    )
    return replace(view, safety=stop)
