"""A robot's skills on disk: a file each, called by its name, in one folder."""

from __future__ import annotations

import itertools
import os
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from lfd.exceptions import StorageUnavailable
from lfd.store.database import DemonstrationStore
from lfd.store.stored import About, Binding
from services.model.alone import alone, unfinished
from services.model.exceptions import NoSuchSkill, SkillMisfit, SkillNameBad, SkillOpen, SkillThere
from services.model.skill_file import Skill, described
from services.process.exceptions import CannotWrite
from services.process.files import make_folder, settle_names

SUFFIX = ".sqlite"
DROPPED = ".dropped"
"""Behind the name of a file whose skill was dropped, with a number from the second of a name on."""

Filler = Callable[[DemonstrationStore], None]
"""Puts into an empty file what a new skill is to hold."""

_BESIDE = ("-wal", "-shm", "-journal")
"""What SQLite keeps beside a file is called so."""

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,63}")


def checked_skill(name: str) -> str:
    """The name itself.

    Raises:
        SkillNameBad: no skill can be called so.
    """
    if _NAME.fullmatch(name) is None:
        raise SkillNameBad(name)
    return name


class Shelf:
    """The skills in a folder.

    Who changes which files there are does so alone; a file that a process has open is neither moved nor taken away.

    Args:
        folder: where they lie; made where it is missing.
        robot: whose they are, by its name on the network.
        suffix: of their files.

    Raises:
        CannotWrite: the folder cannot be made.
    """

    def __init__(self, folder: Path, robot: str, suffix: str = SUFFIX) -> None:
        self.folder = folder
        self.robot = robot
        self._suffix = suffix
        try:
            make_folder(folder)
        except OSError as error:
            raise CannotWrite(folder, error.strerror or str(error)) from None

    def names(self) -> list[str]:
        """Of all skills, in the order of the alphabet."""
        files = (path for path in self.folder.iterdir() if path.suffix == self._suffix and path.is_file())
        told = (path for path in files if not path.name.startswith(".") and not path.name.endswith(_BESIDE))
        return sorted(map(self._name, told))

    def all(self) -> list[Skill]:
        """What is known of each; files of other programs are left out."""
        found = (described(name, self.path(name)) for name in self.names())
        # Without a suffix a file that is no database may be anything.
        return [skill for skill in found if skill is not None and (self._suffix or not skill.fault)]

    def find(self, name: str) -> Skill:
        """What is known of one.

        Raises:
            NoSuchSkill: there is none.
        """
        found = described(name, self.path(name)) if name in self.names() else None
        if found is None:
            raise NoSuchSkill(name, self.names(), self.folder)
        return found

    def dropped(self) -> list[str]:
        """Names of those that can be brought back."""
        names = (path.name for path in self.folder.glob(f"*{self._suffix}{DROPPED}*"))
        return sorted({name[: name.rindex(self._suffix + DROPPED)] for name in names})

    def read(self, name: str) -> DemonstrationStore:
        """The demonstrations of a skill, to be closed by who asked.

        Raises:
            NoSuchSkill: there is none.
            StorageError: its file cannot be used.
        """
        if name not in self.names():
            raise NoSuchSkill(name, self.names(), self.folder)
        return DemonstrationStore(self.path(name))

    def take(self, name: str, binding: Binding, now_s: float) -> DemonstrationStore:
        """The demonstrations of a skill that is taken into use; made, where there is none.

        Args:
            name: of the skill.
            binding: that it is to be good for.
            now_s: since 1970-01-01 UTC [s].

        Raises:
            SkillMisfit: it was learnt for something else.
            StorageError: its file cannot be used.
        """
        with alone(self.folder):
            store = DemonstrationStore(self.path(name))
            try:
                held = store.about() or About(binding, created_s=now_s)
                if not held.binding.fits(binding):
                    raise SkillMisfit(name, held.binding, binding)
                store.check(binding)
                store.describe(held._replace(binding=binding, used_s=now_s))
            except BaseException:
                store.close()
                raise
        return store

    def new(self, name: str, about: About) -> None:
        """Make an empty skill.

        Raises:
            SkillNameBad: it cannot be called so.
            SkillThere: there is one.
        """
        self.put(name, lambda store: store.describe(about))

    def put(self, name: str, fill: Filler) -> None:
        """Make a skill that is there once it is whole, and is not there before.

        Args:
            name: of the skill.
            fill: what its empty file is filled by.

        Raises:
            SkillNameBad: it cannot be called so.
            SkillThere: there is one.
            StorageError: it cannot be written.
        """
        with alone(self.folder), unfinished(self.folder, checked_skill(name)) as part:
            self._check_free(name)
            with DemonstrationStore(part) as store:
                fill(store)
                store.settle()
            self._name_file(part, name)

    def copy(self, name: str, copied: str) -> None:
        """Make a skill that is as another one is now; raises as `read` and `put`."""
        with alone(self.folder), unfinished(self.folder, checked_skill(copied)) as part:
            self._check_free(copied)
            with self.read(name) as store:
                store.copy_to(part)
            self._name_file(part, copied)

    def rename(self, name: str, renamed: str) -> None:
        """Give a skill another name.

        Raises:
            NoSuchSkill: there is none.
            SkillNameBad, SkillThere: it cannot be called so.
            SkillOpen: a process has it open.
        """
        with alone(self.folder):
            self._check_free(checked_skill(renamed), but=name)
            self._settled(name)
            self.path(name).rename(self.path(renamed))
            settle_names(self.folder)

    def drop(self, name: str) -> Path:
        """Take a skill away; its file is kept, and where it is now is told.

        Raises:
            NoSuchSkill: there is none.
            SkillOpen: a process has it open.
        """
        with alone(self.folder):
            self._settled(name)
            path, before = self.path(name), len(self._kept(name))
            kept = path.with_name(f"{path.name}{DROPPED}" + (f"-{before + 1}" if before else ""))
            path.rename(kept)
            settle_names(self.folder)
        return kept

    def bring_back(self, name: str) -> None:
        """Bring back a skill that was dropped, the last one of its name.

        Raises:
            NoSuchSkill: none of this name was.
            SkillThere: there is another one of its name by now.
        """
        with alone(self.folder):
            kept = self._kept(name)
            if not kept:
                raise NoSuchSkill(name, [*self.names(), *self.dropped()], self.folder)
            self._check_free(name)
            kept[-1].rename(self.path(name))
            settle_names(self.folder)

    @contextmanager
    def only(self, name: str) -> Iterator[DemonstrationStore]:
        """The demonstrations of a skill that no process has open, or opens meanwhile; raises as `rename`."""
        with alone(self.folder):
            self._settled(name)
            with self.read(name) as store:
                yield store

    def path(self, name: str) -> Path:
        """Of a skill's file."""
        return self.folder / f"{name}{self._suffix}"

    def _kept(self, name: str) -> list[Path]:
        """Files of the skills of a name that were dropped, the first one first."""
        file = f"{self.path(name).name}{DROPPED}"
        numbered = (f"{file}-{number}" for number in itertools.count(2))
        names = itertools.chain((file,), numbered)
        return list(itertools.takewhile(Path.is_file, (self.folder / one for one in names)))

    def _name(self, path: Path) -> str:
        return path.name.removesuffix(self._suffix) if self._suffix else path.name

    def _check_free(self, name: str, but: str = "") -> None:
        there = next((one for one in self.names() if one.casefold() == name.casefold() and one != but), None)
        if there is not None:
            raise SkillThere(name, there)

    def _settled(self, name: str) -> None:
        """Bring all of a skill into its one file, where nobody has it open."""
        with self.read(name) as store:
            try:
                store.settle()
            except StorageUnavailable as error:
                raise (SkillOpen(name, self.robot) if error.passes else error) from None

    def _name_file(self, part: Path, name: str) -> None:
        with part.open("rb") as file:
            os.fsync(file.fileno())
        part.rename(self.path(name))
        settle_names(self.folder)
