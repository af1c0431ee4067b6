"""What can go wrong in learning from demonstration.

LfdError
├── WrongShape              an array has not the shape it must have
├── NotNumbers              what is to be an array holds something else than numbers, or rows of different lengths
├── NotFinite               an array or number contains NaN or infinity
├── TooFewPoints            a trajectory needs at least two points
├── TooFewWaypoints         a motion through waypoints needs at least three
├── TooFewDemonstrations    a model needs at least one demonstration
├── InvalidDuration         a duration is not positive
├── NotUnitQuaternion       an orientation is not a unit quaternion
├── TimesNotIncreasing      the times of samples do not increase strictly
├── OutOfRange              a number lies outside its range
├── EmptyPart               a part of a motion holds nothing of it
├── OpeningMismatch         the gripper takes part in one motion and not in another that belongs to it
├── PartialDemonstration    a model is to begin with a part of a motion
├── UnreachableViaPoint     a via-point cannot be met without swinging the motion
├── NothingToTakeBack       a model without a correction has none to forget
├── TableError              a table cannot be read, or its numbers cannot be meant
└── StorageError            the store's file cannot be used
    ├── StorageUnavailable  it cannot be opened or written now, through no fault of its own
    ├── ForeignFile         it is another program's
    ├── BoundElsewhere      what it holds was learnt for another scene or robot
    ├── NothingToUndo       it holds no such demonstration in use
    └── NothingToRedo       it holds no such demonstration that was taken back
"""

import math
from collections.abc import Sequence
from numbers import Real
from pathlib import Path


class LfdError(Exception):
    """Base of all errors of the package `lfd`."""


class WrongShape(LfdError):
    """An array has not the shape it must have."""

    def __init__(self, name: str, expected: str, actual: tuple[int, ...]) -> None:
        self.name = name
        self.expected = expected
        self.actual = actual
        super().__init__(f"{name} has shape {actual}: give an array of shape {expected}")


class NotNumbers(LfdError):
    """What is to be an array holds something else than numbers, or rows of different lengths."""

    def __init__(self, name: str) -> None:
        self.name = name
        super().__init__(f"{name} is no array of numbers: give numbers only, and rows of one length")


class NotFinite(LfdError):
    """An array or number contains NaN or infinity."""

    def __init__(self, name: str, index: tuple[int, ...]) -> None:
        self.name = name
        self.index = index
        where = f" at index {index}" if index else ""
        super().__init__(f"{name} is not a finite number{where}: drop or repair the sample")


class TooFewPoints(LfdError):
    """A trajectory needs at least two points."""

    def __init__(self, name: str, count: int) -> None:
        self.name = name
        self.count = count
        super().__init__(f"{name} has {count} point(s): a trajectory needs at least 2")


class TooFewWaypoints(LfdError):
    """A motion through waypoints needs at least three."""

    def __init__(self, count: int) -> None:
        self.count = count
        super().__init__(f"{count} waypoint(s): a motion needs at least 3, its two ends and one between")


class TooFewDemonstrations(LfdError):
    """A model needs at least one demonstration."""

    def __init__(self) -> None:
        super().__init__("no demonstration: a model needs at least one")


class InvalidDuration(LfdError):
    """A duration is not positive."""

    def __init__(self, duration: float) -> None:
        self.duration = duration
        super().__init__(f"duration is {duration:g} s: it must be positive")


class NotUnitQuaternion(LfdError):
    """An orientation is not a unit quaternion."""

    def __init__(self, name: str, index: int, norm: float) -> None:
        self.name = name
        self.index = index
        self.norm = norm
        super().__init__(f"{name}[{index}] has norm {norm:g}: give unit quaternions (w, x, y, z)")


class TimesNotIncreasing(LfdError):
    """The times of samples do not increase strictly."""

    def __init__(self, index: int, previous: float, time: float, name: str = "times") -> None:
        self.name = name
        self.index = index
        self.previous = previous
        self.time = time
        super().__init__(f"{name}[{index}] = {time:g} s follows {previous:g} s: order the samples, one a time")


class OutOfRange(LfdError):
    """A number lies outside its range, or is none."""

    def __init__(self, name: str, value: object, allowed: str) -> None:
        self.name = name
        self.value = value
        self.allowed = allowed
        shown = f"{value:g}" if isinstance(value, Real) else repr(value)
        super().__init__(f"{name} is {shown}: it must be {allowed}")


class EmptyPart(LfdError):
    """A part of a motion holds nothing of it."""

    def __init__(self, first: float, last: float) -> None:
        self.first = first
        self.last = last
        super().__init__(f"the part from phase {first:g} to {last:g} is empty: let it end after it begins")


class OpeningMismatch(LfdError):
    """The gripper takes part in one motion and not in another one that belongs to it."""

    def __init__(self) -> None:
        super().__init__(
            "one motion says how far the gripper is open and another does not: give all an opening, or none"
        )


class PartialDemonstration(LfdError):
    """A model is to begin with a part of a motion."""

    def __init__(self, first: float, last: float) -> None:
        self.first = first
        self.last = last
        super().__init__(
            f"the demonstration speaks of phases {first:g} to {last:g} only: a model begins with whole motions"
        )


class UnreachableViaPoint(LfdError):
    """A via-point cannot be met without swinging the rest of the motion.

    Attributes:
        phase: Of the via-point.
        offset: How far it lies off the motion [m].
        swing: How far the motion would be led away to meet it [m]; infinite where nothing meets it.
    """

    def __init__(self, phase: float, offset: float, swing: float) -> None:
        self.phase = phase
        self.offset = offset
        self.swing = swing
        cost = f"would swing it by {swing:.3g} m" if swing < math.inf else "cannot be met: the motion is fixed there"
        super().__init__(
            f"the via-point at phase {phase:g}, {offset:.3g} m off the motion, {cost};"
            " put it farther from the start and from other via-points in time, or give it a wider covariance"
        )


class NothingToTakeBack(LfdError):
    """A model without a correction has none to forget."""

    def __init__(self) -> None:
        super().__init__("the model has no correction to take back: it only knows its first demonstrations")


class TableError(LfdError):
    """A table cannot be read, or its numbers cannot be meant.

    Attributes:
        path: The file.
        reason: What is wrong, and what would be right.
        line: Where, from 1; None where it is the file as a whole.
        column: By its name; None where it is the line as a whole.
        value: What stands there; None where nothing does.
    """

    def __init__(
        self, path: Path, reason: str, *, line: int | None = None, column: str | None = None, value: str | None = None
    ) -> None:
        self.path = path
        self.reason = reason
        self.line = line
        self.column = column
        self.value = value
        place = [f"line {line}"] if line is not None else []
        place += [f"column {column}"] if column is not None else []
        super().__init__(f"{path}: {', '.join(place)}{': ' if place else ''}{reason}")


class StorageError(LfdError):
    """The file of a demonstration store cannot be used."""

    def __init__(self, path: Path, reason: str, remedy: str) -> None:
        self.path = path
        self.reason = reason
        self.remedy = remedy
        super().__init__(f"{path}: {reason}; {remedy}")


class StorageUnavailable(StorageError):
    """The file cannot be opened or written now, through no fault of its own.

    Attributes:
        passes: Whether waiting may help: another process holds it, or the disk is full.
    """

    def __init__(self, path: Path, reason: str, remedy: str, *, passes: bool) -> None:
        self.passes = passes
        super().__init__(path, reason, remedy)


class ForeignFile(StorageError):
    """The file is a database of another program's."""

    def __init__(self, path: Path) -> None:
        super().__init__(path, "this is not a file of demonstrations", "choose another file name")


class BoundElsewhere(StorageError):
    """The demonstrations of a file are good for another scene or robot than they are wanted for."""

    def __init__(self, path: Path, held: Sequence[str], wanted: str) -> None:
        self.held = tuple(held)
        self.wanted = wanted
        reason = f"it was learnt for {' and for '.join(self.held)}, and is wanted for {wanted}"
        super().__init__(path, reason, "choose another file, or the scene and robot that it is for")


class NothingToUndo(StorageError):
    """The store holds no such demonstration, or it was taken back already.

    Attributes:
        version: That the demonstration made.
    """

    def __init__(self, path: Path, version: int) -> None:
        self.version = version
        super().__init__(path, f"no demonstration {version} is in use", "choose one that is")


class NothingToRedo(StorageError):
    """The store holds no such demonstration, or it is in use already.

    Attributes:
        version: That the demonstration made.
    """

    def __init__(self, path: Path, version: int) -> None:
        self.version = version
        super().__init__(path, f"no demonstration {version} was taken back", "choose one that was")
