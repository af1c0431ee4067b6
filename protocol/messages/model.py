"""What the model says: the class `model`."""

from __future__ import annotations

from protocol.messages.values import Array, Count, Message, Motion, Name, Vector3


class Prediction(Message, frozen=True, kw_only=True):
    """What the model would do; repeated until the next one is made.

    Attributes:
        id: by which everybody speaks of it; another one in every prediction, of every model process. 0 for none.
        motion: in the base frame.
        deviations: one standard deviation on each axis, shape (n, 3) [m].
        model_version: of the model that predicts.
        object_position: the condition, in the base frame [m].
    """

    id: Count = 0
    motion: Motion
    deviations: Array
    model_version: Count
    object_position: Vector3


class ModelState(Message, frozen=True, kw_only=True):
    """The learnt model as it lies on disk, and what it is good for.

    Attributes:
        kind: which model.
        version: grows with every change, undo included.
        demonstrations: that it started from.
        updates: since then.
        scene: that it is good for.
        robot_kind: the kind of robot that it is good for.
    """

    kind: Name
    version: Count
    demonstrations: Count
    updates: Count
    scene: Name
    robot_kind: Name = ""
