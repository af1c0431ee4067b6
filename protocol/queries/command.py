"""What the robot is asked to do."""

from __future__ import annotations

from enum import Enum
from typing import Annotated

import msgspec

from protocol.messages import Condition, Count, Duration, Fraction, Mode, Name, Part, Pose, Vector3
from protocol.queries.answer import Change


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
