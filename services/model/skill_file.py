"""What the file of a skill says of it, without its motions."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from lfd.exceptions import ForeignFile, StorageError
from lfd.store.database import DemonstrationStore
from lfd.store.stored import About, Binding, Counts
from services.model.exceptions import SkillMisfit

_NOTHING = Counts(0, 0)


@dataclass(frozen=True)
class Skill:
    """What is known of a skill without its motions.

    Attributes:
        name: by which it is called.
        path: of its file.
        about: what it says of itself; None where it holds nothing and nobody has said it.
        version: of its model.
        counts: of demonstrations and corrections in use.
        fault: why it cannot be used; empty where it can.
    """

    name: str
    path: Path
    about: About | None = None
    version: int = 0
    counts: Counts = _NOTHING
    fault: str = ""

    def misfit(self, wanted: Binding) -> str:
        """Why it is of no use to a robot in a task; empty where it is."""
        if self.fault or self.about is None or self.about.binding.fits(wanted):
            return self.fault
        return str(SkillMisfit(self.name, self.about.binding, wanted))


def described(name: str, path: Path) -> Skill | None:
    """What a file says of the skill in it; None where it is another program's."""
    # Only SQLite opens it: who closes a file that it has open as well gives up its locks on it.
    skill = Skill(name, path)
    try:
        with DemonstrationStore(path) as store:
            version = store.version
            return replace(skill, about=store.about(), version=version, counts=store.counts(version))
    except ForeignFile:
        return None
    except StorageError as error:
        return replace(skill, fault=f"{error.reason}; {error.remedy}")
