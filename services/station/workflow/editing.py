"""The waypoints while the operator leads, and after: stored where the hand has led the robot, moved, taken away."""

from __future__ import annotations

from dataclasses import replace

from protocol.messages import Method, Mode, Waypoint
from services.station.workflow.action import Action
from services.station.workflow.approach import LEAST_WAYPOINTS, edited
from services.station.workflow.state import Phase, Workflow
from services.station.workflow.view import View

EDITING = frozenset({Action.STORE, Action.DELETE, Action.EARLIER, Action.LATER, Action.CLEAR})
"""What can be done with waypoints."""


def offered(state: Workflow, view: View) -> frozenset[Action]:
    """What the operator may do with the waypoints now."""
    alone = state.phase is Phase.EXECUTING and state.mode is not Mode.TEACH
    if state.approach.method is not Method.WAYPOINTS or alone:
        return frozenset()
    possible = set(EDITING) if state.approach.waypoints else {Action.STORE}
    return frozenset(possible if _here(state, view) is not None else possible - {Action.STORE})


def heard(state: Workflow, view: View) -> Workflow:
    """With what was pressed about the waypoints."""
    if not view.actions & offered(state, view):
        return state
    return replace(state, approach=edited(state.approach, view.presses, _here(state, view)))


def lacking(state: Workflow) -> int:
    """How many waypoints are missing for a motion."""
    return max(0, LEAST_WAYPOINTS - len(state.approach.waypoints))


def _here(state: Workflow, view: View) -> Waypoint | None:
    """What is stored: where the hand has led the robot, or left it, and to what opening the gripper was told to go.

    What was measured would hold nothing: fingers that are to press on a thing are told to go on, to where it is.
    """
    there, robot = state.led and state.mode is Mode.TEACH, view.robot
    if robot is None or not there:
        return None
    grasps = view.scene is not None and view.scene.wide_open > 0.0
    opening = max(robot.opening_reference, 0.0) if grasps else None
    return Waypoint(robot.measured.position, robot.measured.orientation, opening)
