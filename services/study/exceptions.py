"""The study's failures.

StudyError
├── ProtocolUnfit      a protocol or questionnaire that contradicts itself
├── NoStudy            a folder that holds none
├── StudyThere         one that holds one already
├── DataSetThere       one that holds something, where a data set is to be
├── StudyInUse         another console or run has the study open (an EnvironmentFault too)
├── StudyFrozen        what was frozen has changed since, and nobody has said why
├── NotFrozen          a study that has to be frozen before people take part
├── FrozenAlready      one that was frozen before, and has begun
├── Mixed              people and simulated participants in one study
├── JournalBroken      a journal that is not as it was written, or of another version
├── ParticipantUnknown no participant has this number
├── ParticipantThere   one has it already
├── AnswerRefused      an answer that is missing, or outside what its question allows
└── NotNow             something that cannot be done at this point of a session
"""

from __future__ import annotations

from pathlib import Path

from services.process.exceptions import EnvironmentFault, ServiceError


class StudyError(ServiceError):
    """Base of what a study raises for a person to read."""


class ProtocolUnfit(StudyError):
    """A file of the study contradicts itself."""

    def __init__(self, path: Path, place: str, reason: str) -> None:
        self.path, self.place, self.reason = path, place, reason
        super().__init__(f"{path}: {place}: {reason}")


class NoStudy(StudyError):
    """The folder holds no study."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        super().__init__(f"there is no study in {folder}: make one with 'retouch study new {folder}'")


class StudyThere(StudyError):
    """The folder is not empty."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        super().__init__(f"{folder} is not empty: a new study wants a folder of its own")


class DataSetThere(StudyError):
    """The folder is not empty."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        super().__init__(f"{folder} is not empty: a data set goes into a new folder, over nothing that is there")


class StudyInUse(StudyError, EnvironmentFault):
    """Somebody else writes the journal."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        super().__init__(f"the study in {folder} is open elsewhere: end that console or run first")


class StudyFrozen(StudyError):
    """Something that was frozen is another now."""

    def __init__(self, folder: Path, changed: tuple[str, ...]) -> None:
        self.folder, self.changed = folder, changed
        super().__init__(
            f"the study in {folder} is frozen, and since then changed: {', '.join(changed)};"
            " put it back, or say why with --deviation 'REASON', which is written down"
        )


class NotFrozen(StudyError):
    """The protocol may still change."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        super().__init__(f"the study in {folder} is not frozen yet: first say 'retouch study freeze {folder}'")


class FrozenAlready(StudyError):
    """A study that was begun is not frozen anew."""

    def __init__(self, folder: Path, at: str) -> None:
        self.folder, self.at = folder, at
        super().__init__(
            f"the study in {folder} was frozen at {at}, and has begun: what changes is a deviation;"
            f" 'retouch study run {folder} --deviation REASON' writes it down, or begin another study in a new folder"
        )


class Mixed(StudyError):
    """Simulated participants and people are never in one study."""

    def __init__(self, folder: Path, *, synthetic: bool) -> None:
        self.folder = folder
        there = "synthetic participants" if synthetic else "people"
        super().__init__(f"the study in {folder} has {there}: take a folder of its own for the others")


class JournalBroken(StudyError):
    """The journal is not as it was written."""

    def __init__(self, path: Path, line: int, reason: str) -> None:
        self.path, self.line, self.reason = path, line, reason
        super().__init__(f"{path}: line {line}: {reason}; nothing was changed in it")


class ParticipantUnknown(StudyError):
    """Nobody has this number."""

    def __init__(self, number: int) -> None:
        self.number = number
        super().__init__(f"there is no participant {number}")


class ParticipantThere(StudyError):
    """The number is taken."""

    def __init__(self, number: int) -> None:
        self.number = number
        super().__init__(f"there is a participant {number} already: each number is one person's")


class AnswerRefused(StudyError):
    """An answer does not fit its question."""

    def __init__(self, question: str, reason: str) -> None:
        self.question, self.reason = question, reason
        super().__init__(f"{question}: {reason}")


class NotNow(StudyError):
    """It is not the time for it."""
