"""The operator's hand leads the robot: waypoints are stored on the way, or the way itself is what is shown."""

from __future__ import annotations

from dataclasses import replace

from protocol import queries
from protocol.messages import Method, Mode
from services.station.workflow.asking import ask, to
from services.station.workflow.episode import press, refused, started_as
from services.station.workflow.settings import Settings
from services.station.workflow.state import Episode, Phase, Workflow
from services.station.workflow.view import Step, View


def lead(state: Workflow, view: View) -> Workflow:
    """The operator asked to lead: from the start, or on from where waypoints were stored last."""
    goes_on = state.mode is Mode.TEACH and state.approach.method is Method.WAYPOINTS and state.approach.waypoints
    if not goes_on:
        return press(replace(state, approach=replace(state.approach, shown=None)), view, Mode.TEACH)
    return to(state, Phase.TAKING_UP, view, pressed=True, refusals=0, taught=None, event="")


def taking_up(state: Workflow, view: View, settings: Settings) -> Step:
    """Have the robot follow the hand."""
    robot = view.robot
    if robot is None:
        return Step(state)
    reply = ask(state, view, queries.TELEOPERATE, lambda intent: queries.Teleoperate(state.epoch, request=intent))
    if isinstance(reply, queries.Refused):
        return refused(state, view, settings, queries.TELEOPERATE, reply)
    if isinstance(reply, Step):
        told = Episode(reply.state.intent, robot.publisher) if reply.ask is not None else state.episode
        return Step(replace(reply.state, episode=told), reply.ask)
    started = started_as(state, reply.episode, view)
    led = state.approach.method is Method.WAYPOINTS
    return Step(to(state, Phase.EXECUTING, view, episode=started, pressed=False, let_go=False, led=led))
