"""What is kept of a demonstration beside its motion: what it is for, what it is good for, whether it is in use."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any, NamedTuple, Self

from lfd.motion.demonstration import Demonstration
from lfd.motion.departure import Departure


class Purpose(Enum):
    """What a demonstration is for the model."""

    INITIAL = "initial"  # one of those that the model is fitted to
    UPDATE = "update"  # a refinement that the model learnt later


class Binding(NamedTuple):
    """What was learnt is good for one scene and one kind of robot only.

    Attributes:
        scene: Its name.
        robot: The robot's kind, not its name on a network; empty where an older file does not say it.
    """

    scene: str
    robot: str

    def fits(self, other: "Binding") -> bool:
        """Whether what is bound to the one may be used for the other."""
        return self.scene == other.scene and (not self.robot or not other.robot or self.robot == other.robot)

    def __str__(self) -> str:
        return f"scene {self.scene} with robot {self.robot}" if self.robot else f"scene {self.scene}"


class About(NamedTuple):
    """What a file of demonstrations says of itself.

    Attributes:
        binding: What it is learnt for.
        author: Who made it; empty where nobody says so.
        notes: For people.
        created_s: When it was made, in seconds since 1970-01-01 UTC; None where that is not known.
        used_s: When it was last taken into use, the same.
    """

    binding: Binding
    author: str = ""
    notes: str = ""
    created_s: float | None = None
    used_s: float | None = None


class Change(NamedTuple):
    """What made a version: a demonstration came into use, or out of it.

    Attributes:
        demonstration: By the version that it made when it was added.
        turn: Which version this is; see `Turn`.
    """

    demonstration: int
    turn: "Turn"


class Record(NamedTuple):
    """A demonstration bit by bit as its file has it.

    Attributes:
        values: Numbers and texts by the names of their columns.
        arrays: Name, number format, shape and bytes of each.
    """

    values: dict[str, Any]
    arrays: tuple[tuple[Any, ...], ...]


class Turn(NamedTuple):
    """The newest change of whether a demonstration is in use.

    Attributes:
        version: Model version that it made; the demonstration's own where it was never taken back.
        in_use: Whether the model is made of it since.
        author: Who did it; empty where that is not known.
        at_s: When, in seconds since 1970-01-01 UTC; None where that is not known.
    """

    version: int
    in_use: bool
    author: str = ""
    at_s: float | None = None


@dataclass(frozen=True, eq=False)
class StoredDemonstration:
    """A demonstration with its place in the history.

    Attributes:
        version: Model version that it created, by which it is called.
        purpose: Initial or update.
        binding: Scene and robot that it was given with.
        demonstration: The motion.
        departure: From what was predicted there before; None where nothing was, or where that is not known.
        turn: Whether the model is made of it, and who saw to that; None where it was only ever added.
    """

    version: int
    purpose: Purpose
    binding: Binding
    demonstration: Demonstration
    departure: Departure | None = None
    turn: Turn | None = None

    @property
    def in_use(self) -> bool:
        """Whether the model is made of it."""
        return self.turn is None or self.turn.in_use


class Made(NamedTuple):
    """What a request has changed.

    Attributes:
        version: Of the model, that it made.
        demonstration: That it added, took back or used again, by its version.
    """

    version: int
    demonstration: int


class Counts(NamedTuple):
    """Of demonstrations in use: what the model starts from, and what it learnt later."""

    initial: int
    updates: int

    @classmethod
    def of(cls, stored: Sequence[StoredDemonstration]) -> Self:
        """Of demonstrations that are all in use."""
        initial = sum(one.purpose is Purpose.INITIAL for one in stored)
        return cls(initial, len(stored) - initial)
