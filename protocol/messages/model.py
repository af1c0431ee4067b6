"""What the model says: the class `model`."""

from __future__ import annotations

import enum
from typing import Annotated

import msgspec

from protocol.messages.values import Array, Count, Fraction, Message, Motion, Name, Vector3

MOST_WAYPOINTS = 64
"""Of a motion: more are a demonstration."""


class Purpose(enum.Enum):
    """What a demonstration is for the model: part of what it starts from, or an update."""

    INITIAL = "initial"
    UPDATE = "update"


class Method(enum.Enum):
    """How a demonstration was given: a prediction corrected while it ran, through waypoints, or led by hand."""

    UNKNOWN = ""
    REFINE = "refine"
    WAYPOINTS = "waypoints"
    DEMONSTRATE = "demonstrate"


class Origin(enum.Enum):
    """Where a motion that can be executed comes from: the model, or what an operator showed."""

    MODEL = "model"
    WAYPOINTS = "waypoints"
    REFINEMENT = "refinement"
    DEMONSTRATION = "demonstration"


class Way(msgspec.Struct, frozen=True):
    """Which of several ways a predicted motion takes.

    Attributes:
        index: of the way, from 0 in the order in which they were taught.
        count: how many ways are known.
        probability: of this one being right.
    """

    index: Count = 0
    count: Annotated[int, msgspec.Meta(ge=1, le=10_000)] = 1
    probability: Fraction = 1.0

    def __post_init__(self) -> None:
        if self.index >= self.count:
            raise ValueError(f"way {self.index} is none of {self.count}, counted from 0")


class Prediction(Message, frozen=True, kw_only=True):
    """What the model would do; repeated until the next one is made.

    Attributes:
        id: by which everybody speaks of it; another one in every prediction, of every model process. 0 for none.
        motion: in the base frame.
        deviations: one standard deviation on each axis, shape (n, 3) [m].
        model_version: of the model that predicts.
        object_position: the condition, in the base frame [m].
        known: how much of the motion was shown or corrected there, from 1, all of it, to 0, nothing.
        way: which of several ways it takes.
        origin: where the motion comes from; nothing is uncertain of one that an operator showed.
        waypoints: phases at which it passes the operator's waypoints, in their order; empty where there are none.
        skill: that predicts, by its name.
    """

    id: Count = 0
    motion: Motion
    deviations: Array
    model_version: Count
    object_position: Vector3
    known: Fraction = 1.0
    way: Way = Way()
    origin: Origin = Origin.MODEL
    waypoints: Annotated[tuple[Fraction, ...], msgspec.Meta(max_length=MOST_WAYPOINTS)] = ()
    skill: Name = ""


class ModelState(Message, frozen=True, kw_only=True):
    """The learnt model as it lies on disk, and what it is good for.

    Attributes:
        kind: which model.
        version: grows with every change, undo included.
        demonstrations: that it started from.
        updates: since then.
        scene: that it is good for.
        robot_kind: the kind of robot that it is good for.
        skill: which of the robot's skills it is, by its name.
    """

    kind: Name
    version: Count
    demonstrations: Count
    updates: Count
    scene: Name
    robot_kind: Name = ""
    skill: Name = ""

    @property
    def empty(self) -> bool:
        """It has learnt nothing to predict from."""
        return not (self.demonstrations or self.updates)
