"""How a motion goes on while it runs: its pace, a pause, steps back and forth; and the part of it to correct."""

from __future__ import annotations

import math
from dataclasses import replace

from protocol import queries
from protocol.messages import Mode, Part
from services.station.words.predictions import extent
from services.station.words.table import say
from services.station.workflow.action import Action
from services.station.workflow.settings import Settings
from services.station.workflow.state import WHOLE, Going, Workflow
from services.station.workflow.view import View

SLOWEST, FASTEST = 0.25, 2.0
"""Of the pace that an operator sets."""

STEP = 0.02
"""Share of the motion that a step covers."""

SHORTEST_PART = 0.02
"""Share of the motion that is worth correcting."""

SETTING = frozenset({Action.PACE, Action.PART})
"""What can be set while the robot stands as well, for the next motion."""


_WAYS = frozenset({Action.PACE, Action.STEP_BACK, Action.STEP_ON, Action.SEEK})
"""That every motion can be led."""


def offered(state: Workflow, view: View) -> frozenset[Action]:
    """What the operator may do with the motion that is under way; what is not heard for a moment takes nothing away."""
    execution, robot = view.execution, view.robot
    if robot is None or not robot.phase.running:
        return frozenset()
    if execution is None:
        return state.offered & (_WAYS | {Action.PLAY, Action.PAUSE})
    if execution.mode is Mode.TEACH:
        return frozenset()
    return _WAYS | ({Action.PLAY} if execution.pace <= 0.0 else {Action.PAUSE})


def heard(state: Workflow, view: View) -> Workflow:
    """With what was pressed about the pace: it is wanted of the robot until it has answered."""
    if Action.PACE in view.actions:
        state = replace(state, pace=_pace(view.argument(Action.PACE), state.pace))
    going = _going(state, view)
    return state if going is None else replace(state, going=going, question=0, intent=0, wants=None)


def begun(state: Workflow, settings: Settings, part: Part) -> Going | None:
    """How a motion that has begun is to go on; None where at its own pace.

    To where the part begins that is corrected it goes as fast as the robot alone would, and pauses there.
    """
    if part.first > 0.0:
        return Going(min(max(settings.refine_s / settings.autonomous_s, 1.0), FASTEST), part.first)
    return Going(state.pace) if state.pace != 1.0 else None


def set_for_next(state: Workflow, view: View) -> Workflow:
    """With what was pressed while the robot stands."""
    if Action.PACE in view.actions:
        state = replace(state, pace=_pace(view.argument(Action.PACE), state.pace))
    if Action.PART in view.actions:
        state = replace(state, part=_part(view.argument(Action.PART)))
    return state


def paused(view: View) -> bool:
    """The motion under way stands because somebody wanted it to."""
    return view.execution is not None and view.execution.pace == 0.0


def elsewhere(view: View) -> str:
    """Why corrections do not count where the motion is now; empty where they do."""
    execution, robot = view.execution, view.robot
    if execution is None or robot is None:
        return ""
    if execution.pace < 0.0:
        return say("workflow.back")
    if not execution.part.first <= robot.progress <= execution.part.last:
        return say("workflow.elsewhere", extent=extent(execution.part))
    return ""


def request(state: Workflow, going: Going, intent: int) -> queries.Pace:
    """The robot is asked to go on like that."""
    return queries.Pace(state.epoch, going.rate, going.until, request=intent)


def _going(state: Workflow, view: View) -> Going | None:
    """What the newest press asks for; None where none does."""
    robot, execution = view.robot, view.execution
    if robot is None or execution is None or execution.mode is Mode.TEACH:
        return None
    now = robot.progress
    wishes = {
        Action.PAUSE: Going(0.0),
        Action.PLAY: Going(state.pace),
        Action.STEP_BACK: _towards(now, now - STEP),
        Action.STEP_ON: _towards(now, now + STEP),
        Action.SEEK: _towards(now, _number(view.argument(Action.SEEK), now)),
    }
    if Action.PACE in view.actions and execution.pace > 0.0:
        wishes[Action.PACE] = Going(state.pace)
    return next((going for action, going in wishes.items() if action in view.actions), None)


def _towards(now: float, phase: float) -> Going:
    """To a phase of the motion, and a pause there; where it is already, a pause."""
    until = min(max(phase, 0.0), 1.0)
    return Going(math.copysign(1.0, until - now), until) if until != now else Going(0.0)


def _pace(text: str, otherwise: float) -> float:
    return min(max(_number(text, otherwise), SLOWEST), FASTEST)


def _part(text: str) -> Part:
    """Two phases; the whole motion where they are none."""
    first, _, last = text.partition(" ")
    begin, end = (min(max(_number(part, edge), 0.0), 1.0) for part, edge in ((first, 0.0), (last, 1.0)))
    return Part(begin, end) if end - begin >= SHORTEST_PART else WHOLE


def _number(text: str, otherwise: float) -> float:
    """What a page says; another value where it says no number."""
    try:
        value = float(text)
    except ValueError:
        return otherwise
    return value if math.isfinite(value) else otherwise
