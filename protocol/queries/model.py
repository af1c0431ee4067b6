"""What the model is asked to predict, to learn, to forget."""

from __future__ import annotations

import msgspec

from protocol.messages import (
    Condition,
    Count,
    Fraction,
    Method,
    ModelState,
    Motion,
    Name,
    Part,
    Pose,
    Prediction,
    Purpose,
    Vector3,
)
from protocol.queries.answer import Change


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
        skill: that is to learn it, by its name; empty for whichever is in use.
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
    skill: Name = ""


class Undo(Change, frozen=True):
    """Take a demonstration back, whichever came after it.

    Attributes:
        purpose: of the newest in use, which is meant where no entry is named.
        entry: of the history, by its id; 0 for the newest.
        operator: who takes it back; empty where nobody does.
        skill: that it is taken back from; see `AddDemonstration`.
    """

    purpose: Purpose = Purpose.UPDATE
    entry: Count = 0
    operator: Name = ""
    skill: Name = ""


class Redo(Change, frozen=True):
    """Use a demonstration again that was taken back.

    Attributes:
        entry: of the history, by its id.
        operator: who wants it back; empty where nobody does.
        skill: see `Undo`.
    """

    entry: Count
    operator: Name = ""
    skill: Name = ""


class Describe(msgspec.Struct, frozen=True):
    """Ask for the model's state."""


class Learnt(msgspec.Struct, frozen=True, tag_field="reply", tag="learnt"):
    """The change is on disk.

    Attributes:
        state: of the model then.
        entry: of the history that was added, taken back or used again; 0 where nothing was asked to change.
        purpose: of that entry, by which and its number people know it.
    """

    state: ModelState
    entry: Count = 0
    purpose: Purpose = Purpose.UPDATE
