"""What can be wrong with a skill, in one line for whoever asked for it.

SkillError
├── NoSuchSkill      this robot has none of this name
├── SkillThere       it has one already, or one whose name differs in capitals only
├── SkillNameBad     a text that no skill can be called by
├── SkillMisfit      it was learnt for another task or another kind of robot
├── SkillOpen        a model process has it open (an EnvironmentFault too)
├── ChoiceLost       the file that says which skill is in use cannot be read
└── ExportUnusable   a file that is no export of a skill, or not as it was written
    └── NoSkillIn    one that is as it was written, and makes no skill
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from lfd.store.stored import Binding
from services.process.exceptions import EnvironmentFault, ServiceError
from services.process.suggestion import nearest


def place(binding: Binding) -> str:
    """What a skill is for, as a person says it."""
    return f"task {binding.scene} on {binding.robot or 'any robot'}"


class SkillError(ServiceError):
    """Base of everything that is wrong with a skill."""


class NoSuchSkill(SkillError):
    """This robot has none of this name."""

    def __init__(self, name: str, known: Sequence[str], folder: Path) -> None:
        self.name = name
        self.folder = folder
        meant = nearest(name, known) or "'retouch skill list' names those that there are"
        super().__init__(f"there is no skill {name!r} in {folder}; {meant}")


class SkillThere(SkillError):
    """There is one of this name already, or of one that differs in capitals only."""

    def __init__(self, name: str, there: str) -> None:
        self.name = name
        self.there = there
        what = "is there already" if name == there else f"differs in capitals only from {there!r}"
        super().__init__(f"skill {name!r} {what}: choose another name")


class SkillNameBad(SkillError):
    """A text that no skill can be called by."""

    def __init__(self, name: str) -> None:
        self.name = name
        super().__init__(
            f"no skill can be called {name[:80]!r}: give 1 to 64 letters, digits, '-', '_' and '.',"
            " a letter or a digit first"
        )


class SkillMisfit(SkillError):
    """It was learnt for another task or another kind of robot."""

    def __init__(self, name: str, held: Binding, wanted: Binding) -> None:
        self.name = name
        self.held = held
        self.wanted = wanted
        super().__init__(
            f"skill {name!r} is for {place(held)}; this robot is {wanted.robot} in {wanted.scene}: choose another skill"
        )


class SkillOpen(SkillError, EnvironmentFault):
    """A model process has it open."""

    def __init__(self, name: str, robot: str) -> None:
        self.name = name
        self.robot = robot
        super().__init__(
            f"the model process of robot {robot!r} has skill {name!r} open:"
            " stop it, or choose another skill at its page"
        )


class ChoiceLost(SkillError):
    """The file that says which skill is in use cannot be read."""

    def __init__(self, path: Path, reason: str) -> None:
        self.path = path
        self.reason = reason
        super().__init__(f"{path}: it does not say which skill is in use ({reason}): delete it, and choose one")


class ExportUnusable(SkillError):
    """A file that is no export of a skill, or not as it was written."""

    def __init__(self, path: Path, reason: str, remedy: str) -> None:
        self.path = path
        self.reason = reason
        super().__init__(f"{path}: {reason}; {remedy}")


class NoSkillIn(ExportUnusable):
    """What an export holds makes no skill, though it is as it was written."""

    def __init__(self, path: Path, why: str) -> None:
        super().__init__(path, f"what it holds is no skill ({why})", "take another copy of it")
