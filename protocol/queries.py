"""The query registry: requests that a process answers, once, as data."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Annotated, Any, Generic, TypeVar

import msgspec

from protocol.history import Compare, Compared, HistoryListed, ListHistory
from protocol.messages import (
    Condition,
    Count,
    Duration,
    Fraction,
    Method,
    Mode,
    ModelState,
    Motion,
    Name,
    Part,
    Pose,
    Prediction,
    Purpose,
    Reason,
    Text,
    Vector3,
)
from protocol.plan import Plan
from protocol.topics import VERSION, checked_name

Req = TypeVar("Req", bound=msgspec.Struct)
Rep = TypeVar("Rep", bound=msgspec.Struct)


class Refused(msgspec.Struct, frozen=True, tag_field="reply", tag="refused"):
    """The answer to a request that was understood and not carried out."""

    reason: Text


class Accepted(msgspec.Struct, frozen=True, tag_field="reply", tag="accepted"):
    """The request is carried out."""


class Change(msgspec.Struct, frozen=True, kw_only=True):
    """A request that changes something: asked twice, done once.

    Attributes:
        request: a random number by which the request is known again, so that a repeated one gets the kept answer and
            changes nothing; 0 for a request that is never repeated.
    """

    request: Count = 0


class AcquireAuthority(Change, frozen=True):
    """Get the authority to command, where nobody else has it.

    Attributes:
        holder: the station's name.
        operator: the person at it.
        take_over: end another holder's lease at once.
        reason: why it is taken over, for who loses it.
    """

    holder: Name
    operator: Name = ""
    take_over: bool = False
    reason: Reason = ""


class AuthorityGranted(msgspec.Struct, frozen=True, tag_field="reply", tag="granted"):
    """The lease: renew it on its topic, put the epoch into every command."""

    epoch: Count
    lease_s: float


class ReleaseAuthority(Change, frozen=True):
    """Give the authority back."""

    holder: Name
    epoch: Count


class AnswerRequest(Change, frozen=True):
    """Give the authority to who asks for it, or keep it.

    Attributes:
        holder: that has it.
        epoch: of its authority.
        number: of the request that is answered.
        give: whether it is given.
    """

    holder: Name
    epoch: Count
    number: Count
    give: bool


class RevokeAuthority(Change, frozen=True):
    """Take the authority from whoever holds it, without taking it oneself: the robot holds.

    Attributes:
        by: who revokes it.
        reason: why, for who loses it.
    """

    by: Name
    reason: Reason


class Adapt(Enum):
    """Which way-point the displacement moves: the next one (eq. 15-17) or the current one (eq. B.7)."""

    NEXT = "next"
    CURRENT = "current"


class Execute(Change, frozen=True):
    """Execute a prediction; its end is announced on the topic state/episode_result.

    Attributes:
        epoch: of the authority.
        mode: autonomous, or with the operator's correction.
        prediction: the id of the model's prediction, as it was announced on the topic model/prediction.
        duration: that the motion is to take [s].
        adapt: which way-point the correction moves.
        part: of the prediction in which corrections count; behind it the motion goes back to what is predicted.
    """

    epoch: Count
    mode: Mode
    prediction: Count
    duration: Duration
    adapt: Adapt = Adapt.NEXT
    part: Part = Part()


class Teleoperate(Change, frozen=True):
    """Let the operator's hand lead the robot, from where it is, until somebody asks to finish.

    Its end, and the motion, are announced on the topic state/episode_result.

    Attributes:
        epoch: of the authority.
    """

    epoch: Count


class EpisodeStarted(msgspec.Struct, frozen=True, tag_field="reply", tag="started"):
    """The episode's number."""

    episode: Count


class Finish(Change, frozen=True):
    """End the running episode here: the operator is satisfied, or gives up."""

    epoch: Count


class Pace(Change, frozen=True):
    """Let the motion that is under way go faster, slower or back.

    Attributes:
        epoch: of the authority.
        rate: of the motion's time: 1 is its own, 0 pauses, a negative one goes back along what was executed.
        until: share of the motion at which it pauses; None where it goes on to its end, or back to its start.
    """

    epoch: Count
    rate: Annotated[float, msgspec.Meta(ge=-2.0, le=2.0)]
    until: Fraction | None = None


class Resume(Change, frozen=True):
    """Go on with an episode that waits after a hold: somebody pressed for it."""

    epoch: Count


class Reset(Change, frozen=True):
    """Back to the start. In simulation the object and the scene are arranged anew.

    What is left out stays as it was put last.

    Attributes:
        epoch: of the authority.
        variant: of the scene.
        object_position: of the object's centre, base frame [m].
        condition: the external state of a scene that has another than the object's position.
        start: pose of the grasping frame from which the next motion starts.
    """

    epoch: Count
    variant: Name | None = None
    object_position: Vector3 | None = None
    condition: Condition | None = None
    start: Pose | None = None


class ReleaseStop(Change, frozen=True):
    """Release the latched emergency stop; moving again needs a new authority."""

    by: Name


class Predict(msgspec.Struct, frozen=True):
    """Predict a motion to the object from the start pose.

    Attributes:
        object_position: that the motion is relative to, base frame [m].
        start: pose of the grasping frame at its beginning.
        condition: the external state that it depends on; empty for the object relative to the start.
    """

    object_position: Vector3
    start: Pose
    condition: Condition = ()


class Predicted(msgspec.Struct, frozen=True, tag_field="reply", tag="predicted"):
    """The prediction."""

    prediction: Prediction


class AddDemonstration(Change, frozen=True):
    """Learn from a motion that reached the object.

    Attributes:
        purpose: what it is for the model.
        motion: in the base frame.
        object_position: that the motion is relative to, base frame [m].
        scene: in which it was given.
        condition: the external state that it was right for; empty for the object relative to the motion's start.
        operator: who gave it; empty where nobody did.
        alpha: of eq. 18, how far the prediction is moved towards the motion; 1 learns the motion itself.
        part: of the motion that was right; the rest stays as predicted.
        method: how it was given.
    """

    purpose: Purpose
    motion: Motion
    object_position: Vector3
    scene: Name
    condition: Condition = ()
    operator: Name = ""
    alpha: Fraction = 1.0
    part: Part = Part()
    method: Method = Method.UNKNOWN


class Undo(Change, frozen=True):
    """Take a demonstration back, whichever came after it.

    Attributes:
        purpose: of the newest in use, which is meant where no entry is named.
        entry: of the history, by its id; 0 for the newest.
        operator: who takes it back; empty where nobody does.
    """

    purpose: Purpose = Purpose.UPDATE
    entry: Count = 0
    operator: Name = ""


class Redo(Change, frozen=True):
    """Use a demonstration again that was taken back.

    Attributes:
        entry: of the history, by its id.
        operator: who wants it back; empty where nobody does.
    """

    entry: Count
    operator: Name = ""


class Describe(msgspec.Struct, frozen=True):
    """Ask for the model's state."""


class Learnt(msgspec.Struct, frozen=True, tag_field="reply", tag="learnt"):
    """The change is on disk.

    Attributes:
        state: of the model then.
        entry: of the history that was added, taken back or used again; 0 where nothing was asked to change.
    """

    state: ModelState
    entry: Count = 0


@dataclass(frozen=True)
class Query(Generic[Req, Rep]):
    """A request that one process answers.

    Attributes:
        name: "<class>/<subject>".
        request: its type.
        reply: the type of a positive answer; the negative one is always `Refused`.
        server: the process that answers.
        max_bytes: of a request or a reply.
        about: one line for people.
    """

    name: str
    request: type[Req]
    reply: type[Rep]
    server: str
    max_bytes: int
    about: str

    @property
    def schema(self) -> str:
        """Announced with every request."""
        return f"{self.request.__name__}/1"

    def key(self, robot: str) -> str:
        """The key expression at which the robot's server answers."""
        return f"retouch/{VERSION}/{checked_name(robot)}/{self.name}/{self.server}"


ACQUIRE = Query("authority/acquire", AcquireAuthority, AuthorityGranted, "robot", 20_480, "get the authority")
ANSWER = Query(
    "authority/answer", AnswerRequest, Accepted, "robot", 20_480, "give the authority to who asks, or keep it"
)
REVOKE = Query("authority/revoke", RevokeAuthority, Accepted, "robot", 20_480, "end the authority of whoever commands")
RELEASE = Query("authority/release", ReleaseAuthority, Accepted, "robot", 20_480, "give the authority back")
EXECUTE = Query("cmd/execute", Execute, EpisodeStarted, "robot", 20_480, "execute a prediction")
TELEOPERATE = Query(
    "cmd/teleoperate", Teleoperate, EpisodeStarted, "robot", 20_480, "lead the robot by hand, without a prediction"
)
FINISH = Query("cmd/finish", Finish, Accepted, "robot", 20_480, "end the episode here")
PACE = Query("cmd/pace", Pace, Accepted, "robot", 20_480, "faster, slower, pause or back")
RESUME = Query("cmd/resume", Resume, Accepted, "robot", 20_480, "go on after a hold")
RESET = Query("cmd/reset", Reset, Accepted, "robot", 20_480, "back to the start")
RELEASE_STOP = Query("safety/release_stop", ReleaseStop, Accepted, "robot", 20_480, "release the emergency stop")
PREDICT = Query("model/predict", Predict, Predicted, "model", 1_048_576, "predict a motion")
PLAN = Query("model/plan", Plan, Predicted, "model", 1_048_576, "make a motion of what an operator showed")
ADD_DEMONSTRATION = Query(
    "model/add_demonstration", AddDemonstration, Learnt, "model", 4_194_304, "learn; answered when it is on disk"
)
UNDO = Query("model/undo", Undo, Learnt, "model", 20_480, "take the newest update back, or any demonstration")
REDO = Query("model/redo", Redo, Learnt, "model", 20_480, "use a demonstration again that was taken back")
HISTORY = Query(
    "model/history", ListHistory, HistoryListed, "model", 1_048_576, "what was learnt, by whom, and how far it led"
)
COMPARE = Query("model/compare", Compare, Compared, "model", 1_048_576, "what a demonstration changes")
DESCRIBE = Query("model/describe", Describe, Learnt, "model", 20_480, "the model as it lies on disk")

QUERIES: tuple[Query[Any, Any], ...] = (
    ACQUIRE,
    ANSWER,
    REVOKE,
    RELEASE,
    EXECUTE,
    TELEOPERATE,
    FINISH,
    PACE,
    RESUME,
    RESET,
    RELEASE_STOP,
    PREDICT,
    PLAN,
    ADD_DEMONSTRATION,
    UNDO,
    REDO,
    HISTORY,
    COMPARE,
    DESCRIBE,
)
