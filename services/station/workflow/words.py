"""The workflow in words and light, for the operator."""

from __future__ import annotations

import math
import re

from protocol.messages import Light, Method, Mode, Origin, Outcome, RobotState, SafetyState, TeachingState
from protocol.messages import Phase as RobotPhase
from services.station.words.heard import heard
from services.station.words.predictions import certainty, way_taken
from services.station.words.table import say
from services.station.workflow import guiding, showing
from services.station.workflow.action import Action
from services.station.workflow.authority import another, missing
from services.station.workflow.deciding import is_unseen, recommended
from services.station.workflow.going import elsewhere, paused
from services.station.workflow.learning import confidence
from services.station.workflow.planning import is_previewed
from services.station.workflow.settings import Settings
from services.station.workflow.state import Phase, Workflow
from services.station.workflow.view import View

_NO_HAND = "no hand"

_HOLDS = (
    ("nobody holds", "authority"),
    ("no operator", "absent"),
    ("nothing was heard", "unheard"),
    ("the operator's keys or device were not heard", "unheard"),
    ("the operator's keys or device are heard", "late"),
    (_NO_HAND, "hand"),
)
"""How what keeps the robot from going on begins, and the words for whoever stands at the page."""

_WAITS = (("it held for", "long"), ("it was asked for under another", "other"))
"""The same of why it waits to be asked."""

_KEPT_BY = re.compile(r" \((.*)\)$")
"""What had kept it, behind why it waits."""


_PARTLY = {
    Method.REFINE: "workflow.teach_part",
    Method.UNKNOWN: "workflow.teach_part",
    Method.WAYPOINTS: "workflow.teach_waypoints",
    Method.DEMONSTRATE: "workflow.teach_demonstration",
}
"""What to do with what was shown and did not succeed."""


def teaching_state(state: Workflow, view: View, settings: Settings) -> TeachingState:
    """What the page shows of the workflow."""
    stop = _stop(view)
    light, text = (Light.RED, stop) if stop else (_light(state, view), _text(state, view, settings))
    return TeachingState(
        phase=state.phase.value,
        text=text,
        event=" ".join(part for part in (state.event, state.notice) if part),
        light=light,
        refinements=state.refinements,
        refinements_allowed=settings.refinements_allowed,
        updates=state.updates,
        updates_allowed=settings.updates_allowed,
        attempts=state.attempts,
        finished=state.phase is Phase.FINISHED,
        loop_closed=state.closure.closed,
        reason=state.reason,
        actions=tuple(sorted(action.value for action in state.offered | ({Action.CONFIDENCE} - settings.settled))),
        recommended=_first(state, view, settings),
        pace=state.pace,
        method=state.approach.method,
        waypoints=state.approach.waypoints,
        basis=state.approach.basis,
        part=state.episode.part if state.episode is not None else state.part,
        confidence=confidence(state, settings),
        led=state.led,
        showing=guiding.told(state, view),
    )


def _first(state: Workflow, view: View, settings: Settings) -> str:
    """What is to be pressed first; empty where there is nothing to choose."""
    if _decides(state):
        return recommended(state, settings).value if state.offered else ""
    first = showing.first(state) if state.phase is Phase.EXECUTING else None
    return first.value if first in state.offered else ""


def _decides(state: Workflow) -> bool:
    """The operator is asked, whether or not what they decide upon is shown yet."""
    return state.phase is Phase.DECIDING or is_previewed(state)


def _stop(view: View) -> str:
    """What is known of a stop; empty where there is none."""
    safety = view.safety
    if safety is not None and safety.emergency_stop:
        stopped = say("workflow.stopped_by", who=_who(safety))
        return f"{stopped} {say('workflow.not_standing')}" if view.stopping else stopped
    return say("workflow.stop_sent") if view.stopping else ""


def _who(safety: SafetyState) -> str:
    """Who stopped, and why; when, the page's stop says, by the clock of whoever reads it."""
    who = safety.by or say("stop.somebody")
    return f"{who} ({safety.reason})" if safety.reason else who


def _light(state: Workflow, view: View) -> Light:
    if _decides(state) or (state.phase is Phase.FINISHED and state.offered):
        return Light.GREEN
    if _asked(state):
        return Light.HOLD
    if state.phase is not Phase.EXECUTING:
        return Light.AMBER
    if view.robot is not None and (view.robot.phase is RobotPhase.HOLD or paused(view)):
        return Light.HOLD
    if state.mode is Mode.AUTONOMOUS:
        return Light.RED
    return Light.GREEN if _may_correct(state, view) else Light.AMBER


def _asked(state: Workflow) -> bool:
    """A motion that waits to be answered is answered in the same form while the authority comes back."""
    return state.phase in (Phase.WAITING, Phase.ACQUIRING) and state.unanswered is not None


def _may_correct(state: Workflow, view: View) -> bool:
    under_way = view.robot is not None and view.robot.phase is RobotPhase.EXECUTE
    return under_way and not state.let_go and (_collided(view) or not elsewhere(view))


def _text(state: Workflow, view: View, settings: Settings) -> str:
    match state.phase:
        case Phase.WAITING | Phase.ACQUIRING | Phase.WATCHING:
            return _without(state, view, settings)
        case Phase.STOPPED:
            return _stopped(view)
        case Phase.EXECUTING:
            return _executing(state, view)
        case _ if _decides(state):
            shows = "" if is_unseen(state) or state.guide.open else showing.deciding(state)
            return shows or _deciding(state, view, settings)
        case Phase.FINISHED:
            return _finished(state)
        case phase:
            return say(f"workflow.{phase.value}")


def _without(state: Workflow, view: View, settings: Settings) -> str:
    """Without the authority: what is waited for, or who has it and what can be done."""
    if _asked(state) and view.robot is not None:
        return _holding(state, view.robot)
    if state.phase is Phase.ACQUIRING:
        return say("workflow.acquiring")
    taker = another(view, settings)
    if state.phase is Phase.WAITING:
        return missing(view, settings) or (say("workflow.taken", who=taker) if taker else "")
    authority = view.authority
    if authority is not None and state.asks and authority.asked == state.asks:
        return say("workflow.asked", who=taker, seconds=math.ceil(authority.asked_left))
    return say("workflow.watching", who=taker) if taker else say("workflow.free")


def _stopped(view: View) -> str:
    """Where no stop is seen: it was released in this moment, or the robot says nothing of it."""
    return say("workflow.unlatched" if view.safety is not None else "workflow.stopped_unheard")


def _finished(state: Workflow) -> str:
    ended = say("workflow.closed") if state.closure.closed else say("workflow.ended", why=state.reason)
    return f"{ended} {say('workflow.begin_again')}" if Action.NEXT in state.offered else ended


def _deciding(state: Workflow, view: View, settings: Settings) -> str:
    """How the last attempt was, and the one thing to do."""
    outcome = f"{outcome_text(state.last, view)} " if state.last else ""
    if state.guide.open and not is_unseen(state):
        return f"{outcome}{showing.guided(state, view)}"
    if state.taught is not None:
        return f"{outcome}{say('workflow.teach' if state.taught.whole else _PARTLY[state.taught.method])}"
    if is_unseen(state):
        return f"{outcome}{say('workflow.unseen')}"
    if state.last:
        then = recommended(state, settings)
        leads_again = then is Action.LEAD and state.approach.method is Method.DEMONSTRATE
        return f"{outcome}{say('workflow.then_show' if leads_again else f'workflow.then_{then.value}')}"
    if state.warned and state.prediction is not None:
        return say("workflow.little_known", known=certainty(state.prediction))
    return say("workflow.ready")


def _executing(state: Workflow, view: View) -> str:
    robot = view.robot
    if robot is None:
        return say("workflow.unheard")
    if robot.phase is RobotPhase.HOLD:
        return _holding(state, robot)
    if robot.phase is not RobotPhase.EXECUTE:
        return _ramping(robot) if robot.phase is RobotPhase.RAMP else say("workflow.over")
    if paused(view):
        return say("workflow.paused")
    if state.mode is Mode.AUTONOMOUS:
        return _watching(state)
    return _correcting(state, view) if state.mode is Mode.REFINE else showing.leading(state, robot)


def _ramping(robot: RobotState) -> str:
    return say("workflow.ramp" if robot.progress > 0.0 else "workflow.ramp_first")


def _watching(state: Workflow) -> str:
    if state.origin is Origin.WAYPOINTS:
        return say("workflow.through")
    if state.origin is Origin.DEMONSTRATION:
        return say("showing.replaying")
    way = way_taken(state.prediction.way) if state.prediction is not None else ""
    return say("workflow.alone_way", way=way) if way else say("workflow.alone")


def _correcting(state: Workflow, view: View) -> str:
    if _collided(view):
        return say("workflow.collided")
    if elsewhere(view):
        return elsewhere(view)
    return say("workflow.let_go" if state.let_go else "workflow.correct")


def _holding(state: Workflow, robot: RobotState) -> str:
    """Whether it goes on by itself, and what keeps it; where it waits to be asked, what had kept it."""
    reason = robot.hold_reason
    if not robot.waiting:
        why = _kept(state, reason) or heard(reason)
        return say("workflow.holds_because", why=why) if why else say("workflow.holds")
    kept_by = _KEPT_BY.search(reason)
    why = _kept(state, kept_by[1] if kept_by is not None else reason, "was_") or _worded(reason, _WAITS)
    why = why or heard(reason)
    return say("workflow.waits_because", why=why) if why else say("workflow.waits")


def _kept(state: Workflow, reason: str, tense: str = "") -> str:
    """What keeps the robot, or had kept it: a key that was down before it counted does once it was let go."""
    if state.let_go and reason.startswith(_NO_HAND):
        return say(f"hold.{tense}let_go")
    return _worded(reason, _HOLDS, tense)


def _worded(reason: str, table: tuple[tuple[str, str], ...], tense: str = "") -> str:
    """The page's words for a reason; empty where it has none."""
    return next((say(f"hold.{tense}{word}") for start, word in table if reason.startswith(start)), "")


def _collided(view: View) -> bool:
    return view.verdict is not None and view.verdict.collision


def outcome_text(outcome: Outcome, view: View) -> str:
    """A verdict as a sentence, with how far the target was missed where that is still told."""
    if outcome.success:
        return say("outcome.success")
    happened = ((say("outcome.collided"), outcome.collision), (say("outcome.kicked_over"), outcome.kicked_over))
    faults = [fault for fault, has in happened if has]
    if not outcome.reached:
        faults += _misses(view)
    return say("outcome.failed", faults=say("outcome.also").join(faults))


def _misses(view: View) -> list[str]:
    """What was not reached: what else the task asks for says more than the distance."""
    verdict = view.verdict
    if verdict is None or verdict.reached:
        return [say("outcome.missed")]
    if verdict.unmet:
        return [say(f"outcome.not_{unmet.value}") for unmet in verdict.unmet]
    if verdict.missed < 0.0:
        return [say("outcome.missed")]
    return [say("outcome.missed_by", distance=f"{verdict.missed * 1e3:.0f}")]
