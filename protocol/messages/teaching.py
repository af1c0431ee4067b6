"""Where the teaching stands and what shows it, also of the class `state`."""

from __future__ import annotations

import enum
from typing import Annotated

import msgspec

from protocol.messages.model import MOST_WAYPOINTS, Method, Origin
from protocol.messages.state import Mode
from protocol.messages.values import Condition, Count, Fraction, Message, Name, Part, Real, Text, Vector3, Waypoint


class Light(enum.Enum):
    """The operator's traffic light: red watch, amber wait, hold where the robot stands in a motion, green act."""

    RED = "red"
    AMBER = "amber"
    HOLD = "hold"
    GREEN = "green"


class Outcome(msgspec.Struct, frozen=True):
    """The three criteria, without their evidence."""

    reached: bool
    kicked_over: bool
    collision: bool

    @property
    def success(self) -> bool:
        """Reached, and neither kicked over nor collided."""
        return self.reached and not self.kicked_over and not self.collision


class Attempt(msgspec.Struct, frozen=True):
    """One episode of a teaching run.

    The motion was relative to the object's position, and right or wrong for the condition; that is empty where it is
    the object relative to the start. Attempts of a run are numbered from 1. One that is not completed was cut short.
    """

    scene: Name
    object_position: Vector3
    model_version: Count
    operator_input: bool
    verdict: Outcome
    duration_s: Real
    variant: Name
    mode: Mode
    condition: Condition = ()
    number: Count = 0
    completed: bool = True


class ShowStep(enum.Enum):
    """What is next where an empty skill is shown its first motions."""

    PLACE = "place"
    SHOW = "show"
    REPLAY = "replay"
    KEEP = "keep"


class Showing(msgspec.Struct, frozen=True):
    """How far the first motions of an empty skill have been shown.

    Attributes:
        step: what is done next at this place.
        place: its number, from 1.
        places: that are shown.
    """

    step: ShowStep
    place: Count
    places: Count


class TeachingState(Message, frozen=True, kw_only=True):
    """Where the teaching workflow (Algorithm 1) stands.

    Attributes:
        phase: a word for the state.
        text: what the operator should know or do, one sentence.
        event: what has happened and what does not work, which he or she should know as well.
        light: may the operator act?
        refinements: attempts at this update so far.
        refinements_allowed: at most.
        updates: of the model in this run.
        updates_allowed: at most.
        attempts: the newest episodes in order; `number` tells which of the run's they are.
        finished: nothing more will happen.
        loop_closed: a prediction failed, was refined, learnt, and a later one succeeded by itself.
        reason: why not, empty where it did.
        actions: what the operator may do now, by name.
        recommended: which of them brings the run on; empty where there is nothing to choose.
        method: by which the operator teaches.
        waypoints: poses of the grasping frame that were stored for a motion through them, in order, with the opening of
            the gripper that each was stored with.
        basis: what the next refinement starts from: a prediction, or what the previous one came to.
        pace: at which motions go; 1 is their own.
        part: of the next refinement in which corrections count, or of the one that runs.
        confidence: how far the model is to believe what it is taught next (alpha of eq. 18).
        led: the newest motion was led by hand to store waypoints on its way: it is no attempt, and has no verdict.
        showing: how far the first motions have been shown; None where the skill has them.
    """

    phase: Name
    text: Text
    event: Text = ""
    light: Light
    refinements: Count = 0
    refinements_allowed: Count = 0
    updates: Count = 0
    updates_allowed: Count = 0
    attempts: Annotated[tuple[Attempt, ...], msgspec.Meta(max_length=100)] = ()
    finished: bool = False
    loop_closed: bool = False
    reason: Text = ""
    actions: Annotated[tuple[Name, ...], msgspec.Meta(max_length=32)] = ()
    recommended: Name = ""
    method: Method = Method.REFINE
    waypoints: Annotated[tuple[Waypoint, ...], msgspec.Meta(max_length=MOST_WAYPOINTS)] = ()
    basis: Origin = Origin.MODEL
    pace: Real = 1.0
    part: Part = Part()
    confidence: Fraction = 1.0
    led: bool = False
    showing: Showing | None = None

    @property
    def told(self) -> str:
        """All that the operator is told."""
        return f"{self.text} {self.event}".strip()


class Recording(Message, frozen=True, kw_only=True):
    """Where the viewer shows and records.

    Attributes:
        path: of the run's .rrd file on the viewer's machine; later parts lie beside it, numbered from -2 on.
        parts: how many files there are.
        size: of all of them together [byte].
        fault: why nothing is recorded now, for people; empty where all is well.
        viewer_url: of the page that shows the live view, with the address that it listens on; the browser knows best
            by which name it reaches it.
        recording_id: changes when the view has to be loaded anew.
        logged_ns: stamp of the newest robot state in the view [ns].
    """

    path: Text
    parts: Count = 1
    size: Count = 0
    fault: Text = ""
    viewer_url: Text
    recording_id: Name
    logged_ns: Count = 0
