"""What happens in a study, each an event of the journal: the raw data, from which all else is derived.

Nothing here says who a participant is: names are kept apart (services.study.personal).
"""

from __future__ import annotations

from typing import Annotated

import msgspec

from services.offline.people.ways import Teaching
from services.study.values import Answer, Long, Number, Recorded, Seconds, Short


class Opened(Recorded, frozen=True, tag="opened"):
    """A console or a run has begun to write.

    Attributes:
        protocol: digest of the protocol's file.
        software: versions, by name.
        synthetic: all its participants are simulated.
        resumed: it was open before.
    """

    protocol: Short
    software: dict[str, Short]
    synthetic: bool = False
    resumed: bool = False


class Deviated(Recorded, frozen=True, tag="deviated"):
    """The study is no longer as it was frozen, and somebody says why.

    Attributes:
        changed: what is another, with its digest or version now; empty for one that is not there any more.
        reason: why.
    """

    changed: dict[Short, Short]
    reason: Long


class Enrolled(Recorded, frozen=True, tag="enrolled"):
    """Somebody takes part.

    Attributes:
        participant: number.
        order: of the methods, their names.
        group: number of that order, from 0.
        language: of the pages.
        synthetic: it is nobody: simulated.
        seed: of one who is.
    """

    participant: Number
    order: tuple[Short, ...]
    group: int
    language: Short
    synthetic: bool = False
    seed: int = 0


class Consented(Recorded, frozen=True, tag="consented"):
    """A participant has agreed to a text.

    Attributes:
        participant: number.
        version: of the text.
        language: of it.
        text: its digest.
    """

    participant: Number
    version: Short
    language: Short
    text: Short


class Answered(Recorded, frozen=True, tag="answered"):
    """A questionnaire was filled in, complete.

    Attributes:
        participant: number.
        instrument: its name.
        version: of it.
        language: in which it was read.
        after: the method that it is about; empty for none.
        shown: names of its questions, in the order in which they came.
        answers: by question.
    """

    participant: Number
    instrument: Short
    version: Short
    language: Short
    shown: tuple[Short, ...]
    answers: dict[Short, Answer]
    after: Short = ""


class Began(Recorded, frozen=True, tag="began"):
    """A part (`services.study.session.course`) begins, in the language of the participant's page; empty for none."""

    participant: Number
    part: Short
    language: Short = ""


class Attempted(Recorded, frozen=True, tag="attempted"):
    """One execution, whoever led it, succeeded or not.

    Attributes:
        participant: number.
        part: of the session.
        number: in that part, from 1.
        teaching: how the operator led; None where the robot moved alone.
        updates: of the model, before it.
        success: all criteria are met.
        reached: the target.
        kicked_over: what was to stay.
        collision: with something.
        active: how long the operator could act [s].
        began: since the part's begin [s].
        ended: since the part's begin [s].
        raw: other times since the part's begin, by name [s].
        why: it ended otherwise than by itself; empty where it did not.
        recording: file that holds it, in the study's folder; empty for none.
    """

    participant: Number
    part: Short
    number: Number
    teaching: Teaching | None
    updates: Annotated[int, msgspec.Meta(ge=0)]
    success: bool
    reached: bool
    kicked_over: bool
    collision: bool
    active: Seconds
    began: Seconds
    ended: Seconds
    raw: dict[Short, Seconds] = msgspec.field(default_factory=dict)
    why: Short = ""
    recording: Short = ""


class BrokenOff(Recorded, frozen=True, tag="broken_off"):
    """An execution did not come to its end, nor did what would have led to one: it is made again.

    Attributes:
        participant: number.
        part: of the session.
        why: it was interrupted, or what its processes said when they ended.
        raw: times since the attempt before, by name, as of one that has ended [s]; they count for nothing.
    """

    participant: Number
    part: Short
    why: Long
    raw: dict[Short, Seconds] = msgspec.field(default_factory=dict)


class Ended(Recorded, frozen=True, tag="ended"):
    """A part is over.

    Attributes:
        participant: number.
        part: of the session.
        passed: the training was, the model was adapted; true for all other parts.
        seconds: that the operator could act in it [s].
    """

    participant: Number
    part: Short
    passed: bool = True
    seconds: Seconds = 0.0


class Paused(Recorded, frozen=True, tag="paused"):
    """The experimenter has interrupted."""

    participant: Number
    reason: Long = ""


class GoneOn(Recorded, frozen=True, tag="gone_on"):
    """It goes on after a pause or a crash.

    Attributes:
        participant: number.
        part: that begins anew.
        since: the last checkpoint [s].
        by_hand: the experimenter has decided it, since that was long ago.
        language: of the participant's page; empty where it was not they who let it go on.
    """

    participant: Number
    part: Short
    since: Seconds
    by_hand: bool
    language: Short = ""


class Invalid(Recorded, frozen=True, tag="invalid"):
    """What was recorded of a part does not count.

    Attributes:
        participant: number.
        part: of the session.
        reason: why.
        repeat: it is done again.
    """

    participant: Number
    part: Short
    reason: Long
    repeat: bool = False


class Noted(Recorded, frozen=True, tag="noted"):
    """The experimenter has written something down."""

    participant: Number | None
    text: Long


class Dropped(Recorded, frozen=True, tag="dropped"):
    """A participant does not go on.

    Attributes:
        participant: number.
        reason: aborted by the experimenter, failed the training, ...
        replaced: somebody else gets the order.
    """

    participant: Number
    reason: Long
    replaced: bool


class Withdrawn(Recorded, frozen=True, tag="withdrawn"):
    """A participant has withdrawn; what was recorded of them is deleted where they want that (`delete`)."""

    participant: Number
    delete: bool


class Erased(Recorded, frozen=True, tag="erased"):
    """Stands where something was that a participant has had deleted: their tombstone.

    Attributes:
        participant: number.
        was: digest of the line that stood there.
    """

    participant: Number
    was: Short


class Finished(Recorded, frozen=True, tag="finished"):
    """A participant has done all of it."""

    participant: Number


class Repaired(Recorded, frozen=True, tag="repaired"):
    """What a power cut left of a line stands before this one.

    Attributes:
        size: of it [byte].
    """

    size: int


OfParticipant = (
    Consented | Answered | Began | Attempted | BrokenOff | Ended | Paused | GoneOn | Invalid | Dropped | Withdrawn
    | Finished
)  # fmt: skip
"""What happens to somebody who was enrolled."""

Event = Opened | Deviated | Enrolled | OfParticipant | Noted | Erased | Repaired


class Entry(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """An event as it stands in the journal.

    Attributes:
        number: counts from 1.
        at: when, UTC, ISO 8601.
        event: what happened.
    """

    number: int
    at: str
    event: Event
