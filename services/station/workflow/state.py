"""What the teaching workflow knows: its settings and its state."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

from protocol import messages
from protocol.messages import Attempt, Condition, Method, Mode, Motion, Origin, Outcome, Part, Vector3
from services.station.workflow.action import Action
from services.station.workflow.approach import Approach
from services.station.workflow.closure import Closure
from services.station.workflow.guide import Guide

WHOLE = Part()
"""All phases of a motion."""


class Phase(Enum):
    """Where the workflow stands."""

    WAITING = "waiting"
    ACQUIRING = "acquiring"
    WATCHING = "watching"
    RESETTING = "resetting"
    LOOKING = "looking"
    PREDICTING = "predicting"
    PLANNING = "planning"
    TAKING_UP = "taking_up"
    STARTING = "starting"
    EXECUTING = "executing"
    LEARNING = "learning"
    TURNING = "turning"
    CHOOSING = "choosing"
    DECIDING = "deciding"
    STOPPED = "stopped"
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
class Episode:
    """The episode that the robot was told to run, until its result has come.

    Attributes:
        request: number of the request for it, which stands in its result.
        robot: the robot process' incarnation that was told.
        number: the robot's own for it; 0 until the robot has said so.
        begun_s: when the robot said so [s].
        finishing: the operator asked to end it.
        part: of the motion in which corrections count.
    """

    request: int
    robot: int
    number: int = 0
    begun_s: float = 0.0
    finishing: bool = False
    part: Part = WHOLE


@dataclass(frozen=True)
class Going:
    """How the motion under way is to go on.

    Attributes:
        rate: of the motion's time; 0 pauses, a negative one goes back.
        until: share of the motion at which it pauses; None for none.
    """

    rate: float
    until: float | None = None


@dataclass(frozen=True)
class Taught:
    """What an episode has shown.

    Attributes:
        motion: that it commanded.
        object_position: that the motion is relative to, base frame [m].
        condition: that it was right for; empty where it is the object's.
        part: of the motion that was right.
        whole: it succeeded, and all that was to be shown or corrected was right.
        method: by which the operator showed it.
    """

    motion: Motion
    object_position: Vector3
    condition: Condition = ()
    part: Part = WHOLE
    whole: bool = True
    method: Method = Method.REFINE


@dataclass(frozen=True)
class Turning:
    """What the operator wants done with an entry of the model's history.

    Attributes:
        entry: by its id; 0 for the newest update.
        in_use: to be used again, or to be taken back.
        skill: whose history that is.
    """

    entry: int = 0
    in_use: bool = False
    skill: str = ""


@dataclass(frozen=True)
class Choosing:
    """Which skill the operator wants to use.

    Attributes:
        name: of the skill.
        new: it is to be made.
    """

    name: str = ""
    new: bool = False


@dataclass(frozen=True)
class Changed:
    """What this station has changed of the model, before the model itself has said so on its topic.

    Attributes:
        skill: that it holds since.
        version: that it came to.
        until_s: until then a state of an older one is from before [s].
    """

    skill: str
    version: int
    until_s: float


@dataclass(frozen=True)
class Owed:
    """A request of the model's that was left unanswered: it is asked again with the same number, so done once."""

    phase: Phase
    intent: int


@dataclass(frozen=True)
class Unanswered:
    """A motion that waits for the operator's answer while the authority is away.

    Attributes:
        since_s: when the authority was lost [s].
        answer: that was given since; None where none was.
    """

    since_s: float
    answer: Action | None = None


@dataclass(frozen=True)
class Workflow:
    """The state of a teaching run.

    Attributes:
        phase: where it stands.
        since_s: when it came there [s].
        question: number of the query under way, which stands in its answer; 0 for none.
        intent: number of the request that this phase asks for, the same until it is answered; 0 before it is asked.
        retry_s: not to ask again before [s].
        refusals: since the operator asked for the episode.
        wants: what the operator asked for in this phase, until it is answered.
        why: the operator's reason for it.
        asks: number of the request to whoever commands for the authority, said on while it is not answered; 0 for none.
        pressed: the operator asked for the next episode; without it nothing moves.
        watches: another station took the authority over: it is asked for only upon a press.
        epoch: of the authority that was granted last.
        holding: that authority was not lost since.
        confirmed: the robot's own state has shown it.
        granted_s: when it was granted [s].
        heard_s: when the robot's state was heard last [s].
        unanswered: what was to be answered when the authority was lost; None where nothing was, or that is long ago.
        episode: that the robot was told to run and whose result has not come; None where there is none.
        owed: to the model.
        turning: what is or was last done with an entry of the model's history.
        choosing: the skill that is or was last chosen.
        confidence: how far the model is to believe what it is taught next; None for what the settings say.
        approach: how the operator teaches at this place.
        led: the newest motion was led by hand to store waypoints on its way: it is no attempt, and has no verdict.
        mode: of the next episode, or of the newest.
        origin: where its motion comes from.
        pace: at which motions go; 1 is their own.
        part: of the next refinement in which corrections count.
        going: how the operator wants the motion under way to go on, until the robot has answered.
        placed: where the target was put.
        looked: where the object was seen [m]; the base frame's origin where there is none.
        condition: that the robot stood in then; empty where it is the object's.
        empty: the model has learnt nothing to predict from, as it said last.
        changed: what the model was when it last changed by this station's doing, and until when one that is older is
            not believed [s]; None where that is long ago.
        guide: how far an empty skill has been shown its first motions.
        unseen: the last look found no target, and none was seen since.
        prediction: the newest.
        warned: the operator was told that little is known at this place; Execute executes all the same.
        taught: what the newest episode has shown, while it can be learnt.
        last: verdict of the newest episode at this place.
        refinements: attempts since the last update.
        learnt: entries of the model's history that were taught at this place and not taken back.
        attempts: the newest episodes of the run.
        closure: whether the loop has closed.
        let_go: keys were held on the way to the start, and have not all been let go since.
        reason: why the run ended without.
        event: what has happened to the run, for the operator; until the next press.
        notice: what does not work in this phase.
        offered: what the operator may do now.
    """

    phase: Phase = Phase.WAITING
    since_s: float = 0.0
    question: int = 0
    intent: int = 0
    retry_s: float = 0.0
    refusals: int = 0
    wants: Action | None = None
    why: str = ""
    asks: int = 0
    pressed: bool = False
    watches: bool = False
    epoch: int = 0
    holding: bool = False
    confirmed: bool = False
    granted_s: float = 0.0
    heard_s: float = 0.0
    unanswered: Unanswered | None = None
    episode: Episode | None = None
    owed: Owed | None = None
    turning: Turning = Turning()
    choosing: Choosing = Choosing()
    confidence: float | None = None
    approach: Approach = field(default_factory=Approach)
    led: bool = False
    mode: Mode = Mode.AUTONOMOUS
    origin: Origin = Origin.MODEL
    pace: float = 1.0
    part: Part = WHOLE
    going: Going | None = None
    placed: Place | None = None
    looked: Vector3 | None = None
    condition: Condition = ()
    empty: bool = False
    changed: Changed | None = None
    guide: Guide = field(default_factory=Guide)
    unseen: bool = False
    prediction: messages.Prediction | None = None
    warned: bool = False
    taught: Taught | None = None
    last: Outcome | None = None
    refinements: int = 0
    learnt: tuple[int, ...] = ()
    attempts: tuple[Attempt, ...] = ()
    closure: Closure = field(default_factory=Closure)
    let_go: bool = False
    reason: str = ""
    event: str = ""
    notice: str = ""
    offered: frozenset[Action] = field(default_factory=frozenset)

    @property
    def updates(self) -> int:
        """Of the model at this place."""
        return len(self.learnt)

    @property
    def held_epoch(self) -> int:
        """Of the authority that this station holds as far as it knows; 0 for none."""
        return self.epoch if self.holding and self.phase is not Phase.FINISHED else 0
