"""What the file of a skill says of it, without its motions."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from lfd.exceptions import StorageError
from lfd.store.database import DemonstrationStore
from lfd.store.schema import APPLICATION_ID
from lfd.store.stored import About, Binding, Counts
from services.model.exceptions import SkillMisfit

_SQLITE, _OURS, _UNSAID = b"SQLite format 3\0", APPLICATION_ID.to_bytes(4), bytes(4)
_APPLICATION = slice(68, 72)  # of a SQLite file: whose it is
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
    if not _is_ours(path):
        return None
    skill = Skill(name, path)
    try:
        with DemonstrationStore(path) as store:
            version = store.version
            return replace(skill, about=store.about(), version=version, counts=store.counts(version))
    except StorageError as error:
        return replace(skill, fault=f"{error.reason}; {error.remedy}")


def is_database(path: Path) -> bool:
    """Whether it begins as a database does, whosever it is."""
    try:
        with path.open("rb") as file:
            return file.read(len(_SQLITE)) == _SQLITE
    except OSError:
        return False


def _is_ours(path: Path) -> bool:
    """Whether it is a skill's, whole or damaged, and not another program's."""
    try:
        with path.open("rb") as file:
            head = file.read(_APPLICATION.stop)
    except OSError:
        return True  # what is wrong with it is said where it is opened
    if not head.startswith(_SQLITE):
        return True
    # Of a new file that is open all but this may still stand in the log beside it.
    begun = head[_APPLICATION] == _UNSAID and path.with_name(f"{path.name}-wal").exists()
    return head[_APPLICATION] == _OURS or begun
