"""Leads the participants of a study through their parts: each act checked, and in the journal before it counts.

It holds nothing that the journal does not. Pages, live trials and synthetic participants all act through it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import datetime

from services.study import events
from services.study.events import Answered, Attempted, Began, BrokenOff, Entry, Event
from services.study.exceptions import NotNow, ParticipantThere, ParticipantUnknown
from services.study.journal import Journal
from services.study.protocol.orders import Allocation, orders
from services.study.protocol.protocol import Protocol
from services.study.session.allocation import allocated
from services.study.session.course import Agree, Fill, Part, Participant, participants
from services.study.session.sheet import Questionnaire, Sheet


class Conductor:
    """Of one study.

    Attributes:
        protocol: of the study.
        instruments: by their names.

    Args:
        protocol: of the study.
        journal: open.
        instruments: that the protocol names.
    """

    def __init__(self, protocol: Protocol, journal: Journal, instruments: Mapping[str, Questionnaire]) -> None:
        self.protocol = protocol
        self.instruments = instruments
        self._journal = journal
        self._participants = participants(journal.entries)
        self._orders = orders(protocol.order, [method.name for method in protocol.methods])
        for one in self._participants.values():  # between a last part and this there may have been a crash
            self._finish(one)

    @property
    def entries(self) -> Sequence[Entry]:
        """Of the journal, the oldest first."""
        return self._journal.entries

    def participants(self) -> Mapping[int, Participant]:
        """All who were enrolled, by their numbers."""
        return self._participants

    def participant(self, number: int) -> Participant:
        """One of them.

        Raises:
            ParticipantUnknown: there is none of that number.
        """
        try:
            return self._participants[number]
        except KeyError:
            raise ParticipantUnknown(number) from None

    def now(self, number: int) -> Part | None:
        """The part that a participant is at, or comes to; None where they are through or gone."""
        return self.participant(number).next(self.protocol)

    def proposed(self) -> int:
        """The next number that nobody has."""
        return max(self._participants, default=0) + 1

    def coming(self) -> tuple[tuple[str, ...], ...]:
        """The orders that are still to be given, those of who dropped out first."""
        replaced = self.protocol.order.replace
        counting = sum(1 for one in self._participants.values() if not (one.gone and replaced))
        allocation = self._allocation()
        return tuple(
            self._orders[allocation.draw()] for _ in range(max(0, self.protocol.order.participants - counting))
        )

    def enrol(self, number: int | None, language: str, *, synthetic: bool = False, seed: int = 0) -> Participant:
        """Somebody takes part, with the next order of the allocation.

        Args:
            number: theirs; None for the next one.
            language: of the pages.
            synthetic: it is nobody.
            seed: of one who is simulated.

        Raises:
            ParticipantThere: the number is taken.
            NotNow: the study has no such language.
        """
        chosen = self.proposed() if number is None else number
        if chosen in self._participants:
            raise ParticipantThere(chosen)
        self.speaks(language)
        group = self._allocation().draw()
        event = events.Enrolled(
            participant=chosen,
            order=self._orders[group],
            group=group,
            language=language,
            synthetic=synthetic,
            seed=seed,
        )
        self._journal.add(event)
        self._participants[chosen] = Participant(event)
        return self._participants[chosen]

    def speaks(self, language: str) -> None:
        """It has this language.

        Raises:
            NotNow: it has not.
        """
        if language not in self.protocol.languages:
            raise NotNow(f"the study speaks {', '.join(self.protocol.languages)}, not {language!r}")

    def consent(self, number: int, language: str) -> None:
        """They agree to the text of that language.

        Raises:
            NotNow: it is not their turn, or there is no such text.
        """
        self._at(number, Agree())
        agreed = self.protocol.consent
        if language not in agreed.text:
            raise NotNow(f"there is no consent text in {language!r}")
        text = agreed.digest(language)
        self._happened(events.Consented(participant=number, version=agreed.version, language=language, text=text))

    def answer(self, number: int, part: Fill, sheet: Sheet) -> None:
        """A questionnaire is filled in.

        Args:
            number: whose answers.
            part: which one, about what.
            sheet: as it was filled in.

        Raises:
            AnswerRefused: they are not complete, or not allowed.
            NotNow: it is not their turn, or another version was shown.
        """
        self._at(number, part)
        instrument = self.instruments[part.instrument]
        if sheet.version != instrument.version:
            raise NotNow(f"version {sheet.version} of {part.instrument} was shown, the study has {instrument.version}")
        instrument.check(sheet.answers)
        self._happened(
            Answered(
                participant=number,
                instrument=part.instrument,
                version=sheet.version,
                language=sheet.language,
                shown=tuple(sheet.shown),
                answers=dict(sheet.answers),
                after=part.after,
            )
        )

    def begin(self, number: int, language: str = "") -> Part:
        """Their next part begins, in the language of their page where they are shown one.

        Raises:
            NotNow: there is none.
        """
        part = self.now(number)
        if part is None:
            raise NotNow(f"participant {number} is through, or gone")
        if self.participant(number).paused:
            raise NotNow(f"participant {number} pauses: go on first")
        self._happened(Began(participant=number, part=part.name, language=language))
        return part

    def attempted(self, attempt: Attempted) -> None:
        """An execution has ended; one that was told before is not told again."""
        known = self.participant(attempt.participant).attempts.get(attempt.part, ())
        if attempt.number > len(known):
            self._happened(attempt)

    def broke_off(self, event: BrokenOff) -> None:
        """An execution came to no end, or what led to one."""
        self._happened(event)

    def end(self, number: int, part: Part, *, passed: bool = True, seconds: float = 0.0) -> None:
        """A part is over; after the last one the participant has finished.

        Raises:
            NotNow: they are not at it.
        """
        self._at(number, part)
        self._happened(events.Ended(participant=number, part=part.name, passed=passed, seconds=seconds))

    def pause(self, number: int, reason: str) -> None:
        """The experimenter interrupts."""
        self._happened(events.Paused(participant=self.participant(number).number, reason=reason))

    def age(self, number: int, now: datetime) -> float:
        """Since the last that was written of a participant, where a resumed part would go on from [s]."""
        last = self.participant(number).last or next(
            entry.at for entry in reversed(self._journal.entries) if getattr(entry.event, "participant", None) == number
        )
        return (now - datetime.fromisoformat(last)).total_seconds()

    def go_on(self, number: int, now: datetime, *, by_hand: bool = False, language: str = "") -> None:
        """After a pause or a crash, from the last checkpoint: the newest entry of the participant.

        Args:
            number: whose session.
            now: time of day.
            by_hand: the experimenter has seen how long ago that is.
            language: of their page, where it was they who pressed.

        Raises:
            NotNow: it is longer ago than the protocol allows, and nobody has decided it.
        """
        since, longest = self.age(number, now), 60.0 * self.protocol.resume.minutes
        if since > longest and not by_hand:
            raise NotNow(
                f"participant {number}'s last checkpoint is {since / 60:.0f} minutes old, of at most"
                f" {self.protocol.resume.minutes:g}: go on all the same, or begin the part anew"
            )
        part = self.now(number)
        name = part.name if part is not None else ""
        since = max(0.0, since)
        self._happened(events.GoneOn(participant=number, part=name, since=since, by_hand=by_hand, language=language))

    def invalid(self, number: int, part: str, reason: str, *, repeat: bool) -> None:
        """What was recorded of a part does not count; nothing of it is lost. What is not repeated is over.

        Raises:
            NotNow: there is no reason, or that part has not begun.
        """
        if not reason.strip():
            raise NotNow("say why it does not count")
        known = self.participant(number)
        if part not in (*known.attempts, *known.ended, known.begun):
            raise NotNow(f"participant {number} has done nothing that is called {part!r}")
        self._happened(events.Invalid(participant=number, part=part, reason=reason.strip(), repeat=repeat))

    def note(self, number: int | None, text: str) -> None:
        """The experimenter writes something down."""
        if number is not None:
            self.participant(number)
        self._journal.add(events.Noted(participant=number, text=text))

    def drop(self, number: int, reason: str) -> None:
        """They do not go on; somebody else gets their order, where the protocol says so."""
        if not reason.strip():
            raise NotNow("say why they do not go on")
        replaced = self.protocol.order.replace
        self.participant(number)
        self._happened(events.Dropped(participant=number, reason=reason.strip(), replaced=replaced))

    def withdraw(self, number: int, *, delete: bool) -> int:
        """They withdraw, at any moment; how many entries became tombstones where they want that.

        Args:
            number: whose.
            delete: what was recorded of them.
        """
        self.participant(number)
        self._happened(events.Withdrawn(participant=number, delete=delete))
        if not delete:
            return 0
        erased = self._journal.erase(number, _erasable)
        self._participants = participants(self._journal.entries)
        return erased

    def _at(self, number: int, part: Part) -> None:
        now = self.now(number)
        if now != part:
            raise NotNow(f"participant {number} is at {now.name if now is not None else 'the end'}, not at {part.name}")

    def _happened(self, event: events.OfParticipant) -> None:
        known = self._participants[event.participant]
        known.hear(self._journal.add(event))
        self._finish(known)

    def _finish(self, one: Participant) -> None:
        """Write down that they have done all of it, once."""
        if not one.finished and not one.gone and one.next(self.protocol) is None:
            one.hear(self._journal.add(events.Finished(participant=one.number)))

    def _allocation(self) -> Allocation:
        return allocated(self.protocol.order, len(self._orders), self._journal.entries)


def _erasable(event: Event) -> bool:
    """What a participant can have deleted: all but that there was one, with which order, and that they withdrew."""
    return not isinstance(event, events.Enrolled | events.Withdrawn | events.Erased)
