"""What a participant's page shows, from the journal and what runs now alone."""

from __future__ import annotations

import math

import msgspec

from services.study.instruments.questions import Question, Words
from services.study.page.desk import Desk
from services.study.page.parts import PartView, part_view
from services.study.page.trials import Live
from services.study.session.course import Adapt, Agree, Fill, Part, Participant, Rest, Train, course
from services.study.session.rules import standing


class _Stage(msgspec.Struct, frozen=True, kw_only=True, tag_field="stage"):
    """Base of all of them."""


class Consent(_Stage, frozen=True, tag="consent"):
    """The text is to be agreed to.

    Attributes:
        version: of it.
        text: by language.
        contact: who answers for the data.
    """

    version: str
    text: Words
    contact: str


class Form(_Stage, frozen=True, tag="form"):
    """A questionnaire is to be filled in.

    Attributes:
        version: of it.
        instructions: by language; empty for none.
        questions: all of them.
        order: names of all answers, as they are asked for.
    """

    version: str
    instructions: Words
    questions: tuple[Question, ...]
    order: tuple[str, ...]


class Ready(_Stage, frozen=True, tag="ready"):
    """A training or a model is to begin.

    Attributes:
        about: the method, by language.
        successes: that end a training.
        of_last: among so many of the last attempts.
        minutes: that it takes at most.
        updates: of a model at most.
        refinements: at one update at most.
        resumed: it was interrupted.
    """

    about: Words
    successes: int
    of_last: int
    minutes: float
    updates: int
    refinements: int
    resumed: bool


class Practice(msgspec.Struct, frozen=True, kw_only=True):
    """How a training stands.

    Attributes:
        succeeded: of the last attempts, as many as the protocol says.
        of_last: so many.
        successes: that are needed.
        minutes: that are left, a begun one too.
    """

    succeeded: int
    of_last: int
    successes: int
    minutes: int


class Trial(_Stage, frozen=True, tag="trial"):
    """It runs.

    Attributes:
        url: of the station's page.
        attempts: so far; in a training, those that count.
        practice: how a training stands; None for a model.
    """

    url: str
    attempts: int
    practice: Practice | None = None


class Break(_Stage, frozen=True, tag="rest"):
    """Between two methods.

    Attributes:
        left_s: of it [s].
        next_method: that comes then.
    """

    left_s: int
    next_method: str


class Wait(_Stage, frozen=True, tag="wait"):
    """Something has to be done first, by the experimenter mostly.

    Attributes:
        why: "paused", "old": the last checkpoint is too old to go on from without them; "busy": another trial runs; or
            "starting": the robot is being made ready, and nobody has anything to do.
    """

    why: str


class End(_Stage, frozen=True, tag="end"):
    """They are through, or gone.

    Attributes:
        how: "finished", "withdrawn", "deleted" or "gone".
        contact: who answers for the data.
    """

    how: str
    contact: str


Stage = Consent | Form | Ready | Trial | Break | Wait | End


class ParticipantView(msgspec.Struct, frozen=True, kw_only=True):
    """The whole page.

    Attributes:
        version: of the page's files.
        title: of the study.
        rehearsal: nobody takes part.
        number: of the participant.
        language: in which they last did something, or as they were enrolled.
        languages: that the study speaks.
        part: that they are at; None at the end.
        step: number of it, from 1.
        steps: of the session.
        stage: what is shown.
    """

    version: str
    title: str
    rehearsal: bool
    number: int
    language: str
    languages: tuple[str, ...]
    part: PartView | None
    step: int
    steps: int
    stage: Stage


def participant_view(desk: Desk, number: int, version: str) -> ParticipantView:
    """What the page of a participant shows now.

    Args:
        desk: of the study.
        number: of the participant.
        version: of the page's files.

    Raises:
        ParticipantUnknown: there is none of that number.
    """
    protocol = desk.conductor.protocol
    known, part = desk.conductor.participant(number), desk.conductor.now(number)
    parts = course(protocol, known.enrolled.order)
    return ParticipantView(
        version=version,
        title=protocol.title,
        rehearsal=desk.synthetic,
        number=number,
        language=known.language,
        languages=protocol.languages,
        part=part_view(desk, part) if part is not None else None,
        step=parts.index(part) + 1 if part is not None else len(parts),
        steps=len(parts),
        stage=_stage(desk, known, part),
    )


def _stage(desk: Desk, known: Participant, part: Part | None) -> Stage:
    protocol = desk.conductor.protocol
    if part is None:
        return End(how=known.end, contact=protocol.recruitment.contact)
    if known.paused:
        return Wait(why="paused")
    match part:
        case Agree():
            text = protocol.consent
            return Consent(version=text.version, text=text.text, contact=protocol.recruitment.contact)
        case Fill():
            return _form(desk, known.number, part)
        case Rest():
            order = known.enrolled.order
            left_s = math.ceil(desk.left_s(known.number, part))
            return Break(left_s=left_s, next_method=order[order.index(part.after) + 1])
        case Train() | Adapt():
            return _trial(desk, known, part)


def _form(desk: Desk, number: int, part: Fill) -> Form:
    instrument = desk.instruments[part.instrument]
    return Form(
        version=instrument.version,
        instructions=instrument.instructions,
        questions=instrument.questions,
        order=desk.order(number, part),
    )


def _runs(desk: Desk, known: Participant, part: Train | Adapt, live: Live) -> Trial:
    if isinstance(part, Adapt):
        return Trial(url=desk.trials.url, attempts=live.attempts)
    rule = desk.conductor.protocol.training
    now = standing(known.attempts.get(part.name, ()), rule, live.lasted)
    practice = Practice(
        succeeded=now.succeeded,
        of_last=rule.of_last,
        successes=rule.successes,
        minutes=math.ceil(now.left_s / 60.0),
    )
    return Trial(url=desk.trials.url, attempts=now.attempts, practice=practice)


def _trial(desk: Desk, known: Participant, part: Train | Adapt) -> Stage:
    live = desk.trials.live()
    if live is not None and (live.number, live.part) == (known.number, part.name):
        return _runs(desk, known, part, live) if live.ready else Wait(why="starting")
    if live is not None:
        return Wait(why="busy")
    resumed = known.begun == part.name
    if resumed and desk.is_old(known.number):
        return Wait(why="old")
    protocol = desk.conductor.protocol
    return Ready(
        about=protocol.method(part.method).about,
        successes=protocol.training.successes,
        of_last=protocol.training.of_last,
        minutes=protocol.training.minutes,
        updates=protocol.task.updates,
        refinements=protocol.task.refinements,
        resumed=resumed,
    )
