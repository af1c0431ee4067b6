"""What people do at the two pages, each about the part that they saw: what comes too late or twice does nothing."""

from __future__ import annotations

from typing import Annotated

import msgspec

from services.study.values import Answer, Long, Number, Short


class _Act(msgspec.Struct, frozen=True, kw_only=True, tag_field="act", forbid_unknown_fields=True):
    """Base of all of them."""


class Consent(_Act, frozen=True, tag="consent"):
    """A participant agrees to the text, in a language."""

    version: Short
    language: Short


class Fill(_Act, frozen=True, tag="fill"):
    """A questionnaire is handed in.

    Attributes:
        part: of the session.
        version: of the questionnaire.
        language: in which it was read.
        answers: by question.
    """

    part: Short
    version: Short
    language: Short
    answers: dict[Short, Answer]


class Begin(_Act, frozen=True, tag="begin"):
    """A training or a model begins, or goes on after an interruption.

    Attributes:
        part: of the session.
        language: in which their page is shown: the robot's speaks it, too.
    """

    part: Short
    language: Short


class EndBreak(_Act, frozen=True, tag="end_break"):
    """A break is over."""

    part: Short


class Withdraw(_Act, frozen=True, tag="withdraw"):
    """A participant does not go on.

    Attributes:
        delete: what was recorded of them is deleted.
    """

    delete: bool


ParticipantAct = Consent | Fill | Begin | EndBreak | Withdraw


class Enrol(_Act, frozen=True, tag="enrol"):
    """Somebody takes part.

    Attributes:
        number: theirs.
        language: of their page.
        name: of the person, kept apart from all else; empty where nobody writes it down.
    """

    number: Number
    language: Short
    name: Short = ""


class Pause(_Act, frozen=True, tag="pause"):
    """The experimenter interrupts."""

    number: Number
    reason: Long = ""


class GoOn(_Act, frozen=True, tag="go_on"):
    """After a pause or a crash.

    Attributes:
        number: of the participant.
        part: that goes on.
        anew: it begins anew, and what was recorded of it so far does not count.
    """

    number: Number
    part: Short
    anew: bool = False


class Invalid(_Act, frozen=True, tag="invalid"):
    """What was recorded of a part does not count."""

    number: Number
    part: Short
    reason: Long
    repeat: bool


class Note(_Act, frozen=True, tag="note"):
    """The experimenter writes something down, about a participant or the study."""

    number: Number | None
    text: Annotated[str, msgspec.Meta(max_length=4000)]


class Abort(_Act, frozen=True, tag="abort"):
    """A participant does not go on."""

    number: Number
    reason: Long


class WithdrawFor(_Act, frozen=True, tag="withdraw_for"):
    """A participant withdraws, and says so to the experimenter: today, or in a year."""

    number: Number
    delete: bool


ConsoleAct = Enrol | Pause | GoOn | Invalid | Note | Abort | WithdrawFor
