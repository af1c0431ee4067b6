"""What the experimenter's console shows, from the journal and what runs now alone."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from services.study import events
from services.study.page.desk import Desk
from services.study.page.parts import PartView, part_view
from services.study.page.trials import Live
from services.study.session.course import Adapt, Participant, Rest, Train, course

NEWEST = 100
"""Notes that are shown."""


class Row(msgspec.Struct, frozen=True, kw_only=True):
    """A participant.

    Attributes:
        number: theirs.
        language: of their page.
        order: of the methods.
        part: that they are at; None at the end.
        step: number of it, from 1.
        steps: of the session.
        state: "ready", "form", "runs", "rest", "paused", "interrupted", "finished", "gone", "withdrawn" or "deleted".
        gone: why.
        age_s: since their last checkpoint [s].
        old: that is longer than the protocol lets go on from without a decision.
        invalid: parts of which something does not count.
    """

    number: int
    language: str
    order: tuple[str, ...]
    part: PartView | None
    step: int
    steps: int
    state: str
    gone: str
    age_s: int
    old: bool
    invalid: int


class AttemptView(msgspec.Struct, frozen=True, kw_only=True):
    """An execution.

    Attributes:
        number: in its part.
        teaching: how it was led; empty where the robot moved alone.
        success: all criteria are met.
        active: how long the operator could act [s].
        faults: "missed", "kicked", "collision".
        why: it ended otherwise than by itself, or does not count.
    """

    number: int
    teaching: str
    success: bool
    active: float
    faults: tuple[str, ...]
    why: str


class Done(msgspec.Struct, frozen=True, kw_only=True):
    """A part of a participant's session.

    Attributes:
        part: which.
        state: "open", "begun", "passed", "failed" or "invalid".
        seconds: that the operator could act in it [s].
        invalid: why it does not count; empty where it does.
        attempts: that count.
        void: that do not.
    """

    part: PartView
    state: str
    seconds: float
    invalid: str
    attempts: tuple[AttemptView, ...]
    void: tuple[AttemptView, ...]


class NoteView(msgspec.Struct, frozen=True, kw_only=True):
    """Something that was written down.

    Attributes:
        at: when, UTC, ISO 8601.
        number: of the participant that it is about; None for the study.
        kind: "note", "pause", "go_on", "invalid", "gone", "withdrawn" or "deviation".
        text: what.
    """

    at: str
    number: int | None
    kind: str
    text: str


class ConsoleView(msgspec.Struct, frozen=True, kw_only=True):
    """The whole page.

    Attributes:
        version: of the page's files.
        title: of the study.
        rehearsal: nobody takes part.
        protocol: its name and version.
        languages: that the study speaks.
        proposed: the next number that nobody has.
        resume_minutes: how old a checkpoint may be to go on from.
        rows: all participants.
        live: what runs now.
        number: whose parts are shown; None for nobody's.
        parts: theirs.
        notes: the newest first.
        coming: orders that are still to be given.
        aimed: participants that are aimed at.
        seed: of the allocation.
    """

    version: str
    title: str
    rehearsal: bool
    protocol: str
    languages: tuple[str, ...]
    proposed: int
    resume_minutes: float
    rows: tuple[Row, ...]
    live: Live | None
    number: int | None
    parts: tuple[Done, ...]
    notes: tuple[NoteView, ...]
    coming: tuple[tuple[str, ...], ...]
    aimed: int
    seed: int


def console_view(desk: Desk, number: int | None, version: str) -> ConsoleView:
    """What the console shows now.

    Args:
        desk: of the study.
        number: of the participant whose parts are looked at; None for nobody's.
        version: of the page's files.
    """
    conductor = desk.conductor
    protocol, everybody = conductor.protocol, conductor.participants()
    chosen = everybody.get(number) if number is not None else None
    return ConsoleView(
        version=version,
        title=protocol.title,
        rehearsal=desk.synthetic,
        protocol=f"{protocol.name} {protocol.version}",
        languages=protocol.languages,
        proposed=conductor.proposed(),
        resume_minutes=protocol.resume.minutes,
        rows=tuple(_row(desk, known) for known in everybody.values()),
        live=desk.trials.live(),
        number=chosen.number if chosen is not None else None,
        parts=_parts(desk, chosen) if chosen is not None else (),
        notes=_notes(conductor.entries),
        coming=conductor.coming(),
        aimed=protocol.order.participants,
        seed=protocol.order.seed,
    )


def _row(desk: Desk, known: Participant) -> Row:
    parts = course(desk.conductor.protocol, known.enrolled.order)
    part = desk.conductor.now(known.number)
    return Row(
        number=known.number,
        language=known.language,
        order=known.enrolled.order,
        part=part_view(desk, part) if part is not None else None,
        step=parts.index(part) + 1 if part is not None else len(parts),
        steps=len(parts),
        state=_state(desk, known),
        gone=known.gone,
        age_s=int(desk.age(known.number)),
        old=desk.is_old(known.number),
        invalid=len({*known.invalid, *(attempt.part for attempt, _ in known.void)}),
    )


def _state(desk: Desk, known: Participant) -> str:
    if known.gone:
        return known.end
    part, live = desk.conductor.now(known.number), desk.trials.live()
    if part is None:
        return "finished"
    if known.paused:
        return "paused"
    if live is not None and live.number == known.number:
        return "runs"
    if isinstance(part, Train | Adapt):
        return "interrupted" if known.begun == part.name else "ready"
    return "rest" if isinstance(part, Rest) else "form"


def _parts(desk: Desk, known: Participant) -> tuple[Done, ...]:
    found = []
    for part in course(desk.conductor.protocol, known.enrolled.order):
        ended = known.ended.get(part.name)
        found.append(
            Done(
                part=part_view(desk, part),
                state=_how_far(known, part.name),
                seconds=ended.seconds if ended is not None else 0.0,
                invalid=known.invalid.get(part.name, ""),
                attempts=tuple(_attempt(attempt, attempt.why) for attempt in known.attempts.get(part.name, ())),
                void=tuple(_attempt(attempt, why) for attempt, why in known.void if attempt.part == part.name),
            )
        )
    return tuple(found)


def _how_far(known: Participant, part: str) -> str:
    ended = known.ended.get(part)
    if part in known.invalid:
        return "invalid"
    if ended is not None or (part == "consent" and known.consented):
        return "failed" if ended is not None and not ended.passed else "passed"
    return "begun" if known.begun == part else "open"


def _attempt(attempt: events.Attempted, why: str) -> AttemptView:
    faults = {"missed": not attempt.reached, "kicked": attempt.kicked_over, "collision": attempt.collision}
    return AttemptView(
        number=attempt.number,
        teaching=attempt.teaching.value if attempt.teaching is not None else "",
        success=attempt.success,
        active=attempt.active,
        faults=tuple(name for name, there in faults.items() if there),
        why=why,
    )


def _notes(entries: Sequence[events.Entry]) -> tuple[NoteView, ...]:
    found: list[NoteView] = []
    for entry in reversed(entries):
        if len(found) == NEWEST:
            break
        told = _told(entry.event)
        if told is not None:
            number = getattr(entry.event, "participant", None)
            found.append(NoteView(at=entry.at, number=number, kind=told[0], text=told[1]))
    return tuple(found)


def _told(event: events.Event) -> tuple[str, str] | None:
    """Kind and text of what belongs among the notes; None for the rest."""
    told = None
    match event:
        case events.Noted(text=text):
            told = "note", text
        case events.Paused(reason=reason):
            told = "pause", reason
        case events.BrokenOff(part=part, why=why):
            told = "broken_off", f"{part}: {why}"
        case events.GoneOn(part=part):
            told = "go_on", part
        case events.Invalid(part=part, reason=reason):
            told = "invalid", f"{part}: {reason}"
        case events.Dropped(reason=reason):
            told = "gone", reason
        case events.Withdrawn():
            told = "withdrawn", ""
        case events.Deviated(changed=changed, reason=reason):
            told = "deviation", f"{', '.join(changed)}: {reason}"
        case _:
            pass
    return told
