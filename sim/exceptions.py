"""What can go wrong in the simulated world.

SimError
├── UnknownScene            no scene of that name
├── UnknownVariant          the scene has no variant of that name
├── WrongPlace              a place has not as many numbers as the scene's targets have
├── TaskUnfit               a task file that cannot be used
├── NoWay                   a task that nobody drew a way for, and none was found
├── UnknownRobot            no robot of that name ships
├── RobotOfItsOwn           another robot is to stand in a scene that is about its own
├── OutOfReach              a position that the robot cannot take, or a place where no target can be
├── CacheUnusable           nothing can be kept: neither in the user's cache folder nor in a temporary one
├── DescriptionMissing      the robot's meshes are not installed
├── DescriptionInvalid      a mesh or link of the robot cannot be used
├── FileMissing             a file that a robot names is not there
├── RobotUnfit              a robot names what its description does not have
├── CameraUnfit             a camera is fixed to a link that is not there
└── DrawingLibraryMissing   neither EGL nor OSMesa is there
"""

from collections.abc import Iterable, Sequence
from pathlib import Path


class SimError(Exception):
    """Base of all errors of the package `sim`."""


class UnknownScene(SimError):
    """There is no scene of that name."""

    def __init__(self, name: str, known: Iterable[str]) -> None:
        self.name = name
        self.known = tuple(known)
        super().__init__(f"unknown scene {name!r}: use one of {', '.join(self.known)}, or the path of a task file")


class UnknownVariant(SimError):
    """The scene has no variant of that name."""

    def __init__(self, scene: str, name: str, known: Iterable[str]) -> None:
        self.scene = scene
        self.name = name
        self.known = tuple(known)
        super().__init__(f"scene {scene!r} has no variant {name!r}: use one of {', '.join(self.known)}")


class TaskUnfit(SimError):
    """A task file that is not there, cannot be parsed, or says what cannot be."""

    def __init__(self, path: Path, reason: str) -> None:
        self.path = path
        self.reason = reason
        super().__init__(f"task file {path}: {reason}")


class NoWay(SimError):
    """Nobody drew a way through a task, and none was found for a robot."""

    def __init__(self, task: str, robot: str, reason: str) -> None:
        self.task = task
        self.robot = robot
        self.reason = reason
        super().__init__(
            f"no way through task {task} was found for {robot}: {reason}; see 'retouch task check', or draw corridors"
        )


class UnknownRobot(SimError):
    """No robot of that name ships."""

    def __init__(self, name: str, known: Iterable[str]) -> None:
        self.name = name
        self.known = tuple(known)
        super().__init__(f"unknown robot {name!r}: use one of {', '.join(self.known)}, or the path of a robot file")


class RobotOfItsOwn(SimError):
    """A scene is about its own robot, and no other can stand in it."""

    def __init__(self, scene: str, kind: str, others: Iterable[str]) -> None:
        self.scene = scene
        self.kind = kind
        super().__init__(
            f"scene {scene} has a robot of its own, the {kind}: leave out --robot-model, or use {', '.join(others)}"
        )


class WrongPlace(SimError):
    """A place has not as many numbers as the scene's targets have."""

    def __init__(self, scene: str, given: int, needed: int) -> None:
        self.scene = scene
        self.given = given
        self.needed = needed
        super().__init__(f"a place in scene {scene!r} has {needed} numbers, not {given}")


class OutOfReach(SimError):
    """A position that the robot cannot take, or a place where no target of the scene can be."""

    def __init__(
        self, what: str, position: Sequence[float], where: str, lower: Sequence[float], upper: Sequence[float]
    ) -> None:
        self.what = what
        self.position = tuple(position)
        self.lower, self.upper = tuple(lower), tuple(upper)
        super().__init__(
            f"{what} {_point(position)} m is beyond {where}: give one from {_point(lower)} to {_point(upper)} m"
        )


class CacheUnusable(SimError):
    """There is no place for what is made once and kept."""

    def __init__(self, reason: str, variable: str) -> None:
        self.reason = reason
        self.variable = variable
        super().__init__(f"cannot keep anything ({reason}): set {variable} to a folder that can be written")


class DescriptionMissing(SimError):
    """The package that holds the robot's links and meshes is not installed."""

    def __init__(self, package: str) -> None:
        self.package = package
        super().__init__(f"the robot description {package!r} is not installed: pip install 'retouch[robot]'")


class DescriptionInvalid(SimError):
    """A part of the robot description is not what its format promises."""

    def __init__(self, part: str, reason: str, remedy: str = "reinstall the package, or mend the file") -> None:
        self.part = part
        self.reason = reason
        super().__init__(f"robot description: {part}: {reason}; {remedy}")


class FileMissing(SimError):
    """A file that a robot names is not there."""

    def __init__(self, robot: str, what: str, path: Path) -> None:
        self.robot = robot
        self.path = path
        super().__init__(f"robot {robot}: {what} {path} is not there: name it as it lies beside the robot's file")


class RobotUnfit(SimError):
    """What a robot names is not in its description, or not as it has to be."""

    def __init__(self, robot: str, fault: str) -> None:
        self.robot = robot
        self.fault = fault
        super().__init__(f"robot {robot}: {fault}")


class CameraUnfit(SimError):
    """A camera is fixed to a link that is not there."""

    def __init__(self, camera: str, link: str) -> None:
        self.camera = camera
        self.link = link
        super().__init__(f"camera {camera}: there is no link {link!r}: name one of the robot's, or none for the scene")


class DrawingLibraryMissing(SimError):
    """No library that draws without a display could be loaded."""

    def __init__(self, reason: str, variables: Sequence[str] = ()) -> None:
        self.reason = reason
        self.variables = tuple(variables)
        remedy = "apt install libegl1 libgl1, or apt install libosmesa6"
        if variables:
            remedy = f"unset {', '.join(variables)}, or {remedy}"
        super().__init__(f"cannot draw without a display ({reason}): {remedy}")


def _point(values: Sequence[float]) -> str:
    return "(" + ", ".join(f"{value:.3f}" for value in values) + ")"
