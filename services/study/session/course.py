"""What a participant goes through, part by part, and how far they are: from the protocol and the journal alone.

Nothing of it lives in a process: whoever opens the journal, after a crash or a week, finds each participant where they
were.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from services.study.events import (
    Answered,
    Attempted,
    Began,
    BrokenOff,
    Consented,
    Dropped,
    Ended,
    Enrolled,
    Entry,
    Finished,
    GoneOn,
    Invalid,
    Paused,
    Withdrawn,
)
from services.study.protocol.protocol import Protocol


@dataclass(frozen=True)
class Agree:
    """To the consent text."""

    name: str = "consent"


@dataclass(frozen=True)
class Fill:
    """A questionnaire.

    Attributes:
        instrument: its name.
        after: the method that it is about; empty for none.
    """

    instrument: str
    after: str = ""

    @property
    def name(self) -> str:
        """Of the part."""
        return f"{self.instrument}/{self.after}" if self.after else self.instrument


@dataclass(frozen=True)
class Train:
    """With a method, until it works."""

    method: str

    @property
    def name(self) -> str:
        """Of the part."""
        return f"{self.method}/training"


@dataclass(frozen=True)
class Adapt:
    """One model, with a method.

    Attributes:
        method: its name.
        model: number, from 1.
    """

    method: str
    model: int

    @property
    def name(self) -> str:
        """Of the part."""
        return f"{self.method}/{self.model}"


@dataclass(frozen=True)
class Rest:
    """A break before the next method."""

    after: str

    @property
    def name(self) -> str:
        """Of the part."""
        return f"break/{self.after}"


Part = Agree | Fill | Train | Adapt | Rest


def course(protocol: Protocol, order: Sequence[str]) -> tuple[Part, ...]:
    """All parts of a session, in their order.

    Args:
        protocol: of the study.
        order: of the methods.
    """
    parts: list[Part] = [Agree(), *(Fill(name) for name in protocol.instruments.before)]
    for number, method in enumerate(order, 1):
        parts += [Train(method), *(Adapt(method, model + 1) for model in range(protocol.task.models))]
        parts += [Fill(name, method) for name in protocol.instruments.after_method]
        if number < len(order) and protocol.breaks.minutes:
            parts.append(Rest(method))
    return (*parts, *(Fill(name) for name in protocol.instruments.after))


@dataclass
class Participant:
    """How far somebody is.

    Attributes:
        enrolled: as they were.
        ended: parts that are over, with how they ended.
        attempts: of each part, the newest round of it; those of invalid rounds are in `void`.
        void: attempts that do not count, and why.
        broken_off: what came to no end.
        answers: by part.
        invalid: parts that do not count and are not repeated, with the reason: they are over, ended or not.
        consented: to the text.
        language: of the pages: in which they last agreed, answered or began; as they were enrolled until then.
        paused: the experimenter has interrupted.
        begun: the part that has begun last.
        begun_at: when, UTC, ISO 8601; empty where none has.
        last: when the newest of all this was, UTC, ISO 8601; empty right after they were enrolled. That something does
            not count is no checkpoint.
        gone: why they do not go on; empty while they do.
        deleted: what was recorded of them, on their wish.
        finished: they have done all of it.
    """

    enrolled: Enrolled
    ended: dict[str, Ended] = field(default_factory=dict)
    attempts: dict[str, list[Attempted]] = field(default_factory=dict)
    void: list[tuple[Attempted, str]] = field(default_factory=list)
    broken_off: list[BrokenOff] = field(default_factory=list)
    answers: dict[str, Answered] = field(default_factory=dict)
    invalid: dict[str, str] = field(default_factory=dict)
    consented: bool = False
    language: str = field(init=False)
    paused: bool = False
    begun: str = ""
    begun_at: str = ""
    last: str = ""
    gone: str = ""
    deleted: bool = False
    finished: bool = False

    def __post_init__(self) -> None:
        """They are spoken to as they were enrolled."""
        self.language = self.enrolled.language

    @property
    def number(self) -> int:
        """Their number."""
        return self.enrolled.participant

    @property
    def end(self) -> str:
        """How it comes to an end for them: "finished", "withdrawn", "deleted" or "gone"."""
        if not self.gone:
            return "finished"
        if self.gone != "withdrawn":
            return "gone"
        return "deleted" if self.deleted else "withdrawn"

    def next(self, protocol: Protocol) -> Part | None:
        """The part that comes now; None where they are through, or gone."""
        return next(iter(self.left(protocol)), None)

    def left(self, protocol: Protocol) -> Iterator[Part]:
        """All parts that are not over, in their order; of a method whose training failed, no models."""
        ended = self.ended.items()
        failed = {name.partition("/")[0] for name, end in ended if name.endswith("/training") and not end.passed}
        for part in course(protocol, self.enrolled.order) if not self.gone else ():
            done = part.name in self.ended or part.name in self.invalid
            over = self.consented if isinstance(part, Agree) else done
            if not over and not (isinstance(part, Adapt) and part.method in failed):
                yield part

    def hear(self, entry: Entry) -> None:
        """Something of theirs has happened."""
        event = entry.event
        self.last = self.last if isinstance(event, Invalid) else entry.at
        self.language = getattr(event, "language", "") or self.language
        match event:
            case Began(part=part):
                self.begun, self.begun_at = part, entry.at
            case Paused() | GoneOn():
                self.paused = isinstance(event, Paused)
            case Consented():
                self.consented = True
            case Answered(instrument=instrument, after=after):
                name = Fill(instrument, after).name
                self.answers[name] = event
                self.ended[name] = Ended(participant=self.number, part=name)
            case Attempted(part=part):
                self.attempts.setdefault(part, []).append(event)
            case BrokenOff():
                self.broken_off.append(event)
            case Ended(part=part):
                self.ended[part] = event
            case Invalid(part=part, reason=reason, repeat=repeat):
                self._void(part, reason, repeat=repeat)
            case Dropped(reason=reason):
                self.gone = reason
            case Withdrawn(delete=delete):
                self.gone, self.deleted = "withdrawn", delete
            case Finished():
                self.finished = True
            case _:
                pass

    def _void(self, part: str, reason: str, *, repeat: bool) -> None:
        self.void += [(attempt, reason) for attempt in self.attempts.pop(part, [])]
        if repeat:
            self.ended.pop(part, None)
            self.invalid.pop(part, None)
        else:
            self.invalid[part] = reason


def participants(entries: Iterable[Entry]) -> dict[int, Participant]:
    """All who were enrolled, by their numbers."""
    found: dict[int, Participant] = {}
    for entry in entries:
        event = entry.event
        if isinstance(event, Enrolled):
            found[event.participant] = Participant(event)
        elif (number := getattr(event, "participant", None)) in found:
            found[number].hear(entry)
    return found
