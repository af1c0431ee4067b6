"""What the teaching workflow knows: its state, what it sees, what it may ask."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from typing import Any

import msgspec

from protocol import messages
from protocol.messages import (
    Attempt,
    Condition,
    EpisodeResult,
    Mode,
    ModelState,
    Motion,
    ObjectPose,
    Outcome,
    Vector3,
)
from protocol.queries import Adapt, Query, Reset


class Action(Enum):
    """What the operator may do."""

    EXECUTE = "execute"
    REFINE = "refine"
    FINISH = "finish"
    NEXT = "next"
    UNDO = "undo"
    END = "end"
    RELEASE_STOP = "release_stop"
    TAKE_OVER = "take_over"


class Phase(Enum):
    """Where the workflow stands."""

    WAITING = "waiting"
    ACQUIRING = "acquiring"
    RESETTING = "resetting"
    LOOKING = "looking"
    PREDICTING = "predicting"
    STARTING = "starting"
    EXECUTING = "executing"
    LEARNING = "learning"
    UNDOING = "undoing"
    DECIDING = "deciding"
    RELEASING = "releasing"
    FINISHED = "finished"


@dataclass(frozen=True)
class Place:
    """Where a reset puts the target of the motion.

    Attributes:
        object_position: of an object, base frame [m]; None where there is none.
        condition: of a scene that has one of its own; None where the object's position decides.
    """

    object_position: Vector3 | None = None
    condition: Condition | None = None


@dataclass(frozen=True)
class Settings:
    """What does not change in a run.

    Attributes:
        holder: this station's name, for the authority.
        operator: the person at this station.
        autonomous_s: duration of an autonomous execution [s].
        refine_s: duration of an execution under correction [s].
        refinements_allowed: attempts at one update.
        updates_allowed: updates at one place.
        adapt: which way-point a correction moves.
        alpha: how far the model believes a refinement (eq. 18).
        variant: arrangement of the scene that the run is about; empty for the one that was changed.
        scripted: the recommended action is taken at once.
        once: the recommended action after the loop has closed is to end.
        arrangement: what every reset asks for, its epoch aside; drawn at random where there is none.
    """

    holder: str
    operator: str = "operator"
    autonomous_s: float = 10.0
    refine_s: float = 20.0
    refinements_allowed: int = 10
    updates_allowed: int = 8
    adapt: Adapt = Adapt.NEXT
    alpha: float = 1.0
    variant: str = ""
    scripted: bool = False
    once: bool = False
    arrangement: Reset | None = None


@dataclass(frozen=True)
class Ask:
    """A query to send; its outcome comes with a later view."""

    query: Query[Any, Any]
    request: msgspec.Struct


@dataclass(frozen=True)
class View:
    """What the station sees in one step; None where nothing fresh is there.

    Attributes:
        now_s: the station's monotonic clock [s].
        robot: the robot's state.
        authority: who may command.
        safety: whether it may move at all.
        scene: in which it stands.
        scene_s: when that came [s].
        model: the model's state.
        seen: the object, as perceived.
        seen_s: when that came [s].
        result: of the newest episode.
        outcome: of the query asked last, in the step in which it came.
        actions: what the operator pressed since the last step.
        drawn: where the target may stand next, for when a place is needed.
    """

    now_s: float
    robot: messages.RobotState | None = None
    authority: messages.AuthorityState | None = None
    safety: messages.SafetyState | None = None
    scene: messages.SceneState | None = None
    scene_s: float = 0.0
    model: ModelState | None = None
    seen: ObjectPose | None = None
    seen_s: float = 0.0
    result: EpisodeResult | None = None
    outcome: Any = None
    actions: frozenset[Action] = frozenset()
    drawn: Place | None = None


@dataclass(frozen=True)
class Workflow:
    """The state of a teaching run.

    Attributes:
        phase: where it stands.
        since_s: when it came there [s].
        asking: a query of this phase is under way.
        retry_s: not to ask again before [s].
        resume: where to go on once the authority is there.
        epoch: of the authority.
        request: number of the newest episode asked for.
        mode: of the next episode.
        placed: where the target was put.
        looked: where the object was seen [m]; the base frame's origin where there is none.
        condition: that the robot stood in then; empty where it is the object's.
        prediction: the newest.
        taught: what the newest successful refinement commanded.
        last: verdict of the newest episode at this place.
        refinements: attempts since the last update.
        updates: at this place.
        attempts: every episode of the run.
        loop_closed: see `loop_has_closed`.
        reason: why the run ended without.
        notice: what the operator should know besides the phase.
        offered: what the operator may do now.
    """

    phase: Phase = Phase.WAITING
    since_s: float = 0.0
    asking: bool = False
    retry_s: float = 0.0
    resume: Phase = Phase.RESETTING
    epoch: int = 0
    request: int = 0
    mode: Mode = Mode.AUTONOMOUS
    placed: Place | None = None
    looked: Vector3 | None = None
    condition: Condition = ()
    prediction: messages.Prediction | None = None
    taught: Motion | None = None
    last: Outcome | None = None
    refinements: int = 0
    updates: int = 0
    attempts: tuple[Attempt, ...] = ()
    loop_closed: bool = False
    reason: str = ""
    notice: str = ""
    offered: frozenset[Action] = field(default_factory=frozenset)


@dataclass(frozen=True)
class Step:
    """The next state, and what to ask."""

    state: Workflow
    ask: Ask | None = None
