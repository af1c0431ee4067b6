"""What the station sees in one step, what it may ask, and what a step comes to."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import msgspec

from protocol import messages
from protocol.messages import EpisodeResult, ModelState, ObjectPose
from protocol.queries import Query
from services.station.press import Press
from services.station.workflow.action import Action
from services.station.workflow.state import Place, Workflow

_ACTIONS = {action.value: action for action in Action}


@dataclass(frozen=True)
class Ask:
    """A query to send; its answer comes with the number in later views, until another question is asked."""

    query: Query[Any, Any]
    request: msgspec.Struct
    number: int


@dataclass(frozen=True)
class Answer:
    """What came of a question: a reply, a refusal, or no answer in time."""

    number: int
    outcome: Any


@dataclass(frozen=True)
class View:
    """What the station sees in one step; None where nothing fresh is there.

    Attributes:
        now_s: the station's monotonic clock [s].
        number: a random one, not 0 and another one in every step, for what is asked in it.
        present: an operator is there.
        steering: a key that steers is held.
        stopping: a stop was pressed at this station, and the robot has not confirmed yet that it stands.
        robot: the robot's state.
        authority: who may command.
        safety: whether it may move at all.
        verdict: the success criteria as they are now.
        execution: of the motion under way.
        scene: in which it stands.
        scene_s: when that came [s].
        model: the model's state.
        seen: the object, as perceived.
        seen_s: when that came [s].
        result: of the newest episode.
        answer: to the question asked last.
        presses: of the operator since the last step, in order.
        drawn: where the target may stand next, for when a place is needed.
        kept_at: where the target stood in the first motions that the skill holds [m]; empty where that is not known.
    """

    now_s: float
    number: int
    present: bool = True
    steering: bool = False
    stopping: bool = False
    robot: messages.RobotState | None = None
    authority: messages.AuthorityState | None = None
    safety: messages.SafetyState | None = None
    verdict: messages.Verdict | None = None
    execution: messages.ExecutionState | None = None
    scene: messages.SceneState | None = None
    scene_s: float = 0.0
    model: ModelState | None = None
    seen: ObjectPose | None = None
    seen_s: float = 0.0
    result: EpisodeResult | None = None
    answer: Answer | None = None
    presses: tuple[Press, ...] = ()
    drawn: Place | None = None
    kept_at: tuple[messages.Vector3, ...] = ()

    def without(self, actions: frozenset[Action]) -> View:
        """As if nobody had pressed any of these."""
        if not self.actions & actions:
            return self
        unheard = {action.value for action in actions}
        return replace(self, presses=tuple(press for press in self.presses if press.action not in unheard))

    @cached_property
    def actions(self) -> frozenset[Action]:
        """What was pressed, as far as it is of this workflow."""
        return frozenset(_ACTIONS[press.action] for press in self.presses if press.action in _ACTIONS)

    def argument(self, action: Action) -> str:
        """What the newest press of an action is about; empty where it was not pressed."""
        arguments = (press.argument for press in reversed(self.presses) if press.action == action.value)
        return next(arguments, "")

    @property
    def empty(self) -> bool:
        """The model says that it has learnt nothing to predict from."""
        return self.model is not None and self.model.empty

    @property
    def latched(self) -> bool:
        """The robot says that the emergency stop is latched."""
        return self.safety is not None and self.safety.emergency_stop


@dataclass(frozen=True)
class Step:
    """The next state, and what to ask."""

    state: Workflow
    ask: Ask | None = None
