"""A study: a folder with its protocol, its questionnaires, and what was recorded.

protocol.toml        what is going to be done
instruments/         questionnaires of its own
frozen.json          what all of this was when it was frozen, with preregistration.md
raw/                 the journal: never changed by hand
identities/          who the participants are: never in an export
recordings/          of the runs
derived/             made again from raw/ at any time
"""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

import msgspec

from services.process.exceptions import CannotWrite
from services.process.files import make_folder, write_whole
from services.study import freezing, preregistration
from services.study.events import Deviated, Enrolled, Entry, Opened
from services.study.exceptions import FrozenAlready, Mixed, NoStudy, NotFrozen, StudyFrozen, StudyThere
from services.study.freezing import Frozen
from services.study.journal import Journal
from services.study.journal import read as read_journal
from services.study.protocol import protocol as protocol_file
from services.study.protocol.protocol import Protocol


@dataclass(frozen=True)
class Study:
    """One that lies in a folder.

    Attributes:
        folder: of it.
        protocol: as its file says now.
    """

    folder: Path
    protocol: Protocol

    @property
    def raw(self) -> Path:
        """Folder of the journal."""
        return self.folder / "raw"

    @property
    def derived(self) -> Path:
        """Folder of what is made from it."""
        return self.folder / "derived"

    def entries(self) -> list[Entry]:
        """What the journal holds.

        Raises:
            JournalBroken: it is not as it was written.
        """
        return read_journal(self.raw)

    def frozen(self) -> Frozen | None:
        """What it was when it was frozen; None where it was not."""
        return freezing.load(self.folder)

    def now(self, at: str = "") -> Frozen:
        """What it is now."""
        return freezing.frozen_now(self._files(), at)

    def freeze(self, at: str) -> Frozen:
        """Freeze it, anew while its journal holds nothing, and write the preregistration.

        Raises:
            FrozenAlready: it was before, and somebody has begun it.
            JournalBroken: the journal is not as it was written.
            CannotWrite: it cannot be written.
        """
        before = self.frozen()
        if before is not None and self.entries():
            raise FrozenAlready(self.folder, before.at)
        frozen = self.now(at)
        path = self.folder / preregistration.FILE
        try:
            write_whole(path, preregistration.text(self.protocol, frozen).encode())
            path = self.folder / freezing.FILE
            write_whole(path, msgspec.json.format(msgspec.json.encode(frozen)) + b"\n")
        except OSError as error:
            raise CannotWrite(path, error.strerror or str(error)) from None
        return frozen

    def journal(
        self,
        utc: Callable[[], datetime],
        *,
        synthetic: bool,
        deviation: str = "",
        marked: Callable[[Entry], None] = lambda _: None,
    ) -> Journal:
        """Open the journal to write, and write down with what.

        Args:
            utc: the time of day.
            synthetic: all participants will be simulated.
            deviation: why it is no longer as it was frozen; empty where it is.
            marked: called with every entry that is added, once it is on the disk.

        Raises:
            NotFrozen: people are to take part, and it is not frozen.
            StudyFrozen: it is no longer as it was frozen, and there is no reason.
            Mixed: the others take part in it.
            StudyInUse: another process has it open.
            JournalBroken: the journal is not as it was written.
        """
        frozen, now = self.frozen(), self.now()
        if frozen is None and not synthetic:
            raise NotFrozen(self.folder)
        journal = Journal(self.raw, utc, marked)
        try:
            self._begin(journal, freezing.changed(frozen or now, now), deviation, synthetic=synthetic)
        except BaseException:
            journal.close()
            raise
        return journal

    def _begin(self, journal: Journal, changed: dict[str, str], deviation: str, *, synthetic: bool) -> None:
        events = [entry.event for entry in journal.entries]
        for event in events:
            if isinstance(event, Enrolled) and event.synthetic != synthetic:
                raise Mixed(self.folder, synthetic=event.synthetic)
        told = next((event.changed for event in reversed(events) if isinstance(event, Deviated)), {})
        if changed and changed != told:
            if not deviation.strip():
                raise StudyFrozen(self.folder, tuple(changed))
            journal.add(Deviated(changed=changed, reason=deviation.strip()))
        opened = any(isinstance(event, Opened) for event in events)
        digest = freezing.digest(self.folder / protocol_file.FILE)
        journal.add(Opened(protocol=digest, software=freezing.software(), synthetic=synthetic, resumed=opened))

    def _files(self) -> dict[str, Path]:
        """That say what is going to be done."""
        own = sorted((self.folder / "instruments").glob("*.toml"))
        return {protocol_file.FILE: self.folder / protocol_file.FILE, **{f"instruments/{p.name}": p for p in own}}


def open_study(folder: Path) -> Study:
    """The study in a folder.

    Raises:
        NoStudy: there is none.
        ConfigurationError: its protocol cannot be read.
        ProtocolUnfit: that contradicts itself.
    """
    path = folder / protocol_file.FILE
    if not path.is_file():
        raise NoStudy(folder)
    return Study(folder, protocol_file.load(path))


def new_study(folder: Path, template: Path) -> Study:
    """Make one from a protocol that is to be changed.

    Raises:
        StudyThere: the folder holds something already.
        ConfigurationError: the template cannot be read.
        ProtocolUnfit: it contradicts itself.
        CannotWrite: the folder cannot be made.
    """
    protocol_file.load(template)
    try:
        if folder.exists() and any(folder.iterdir()):
            raise StudyThere(folder)
        make_folder(folder)
        make_folder(folder / "instruments")
        shutil.copyfile(template, folder / protocol_file.FILE)
    except OSError as error:
        raise CannotWrite(folder, error.strerror or str(error)) from None
    return open_study(folder)
