"""Where both pages do what they do: through the conductor and the trials, one at a time."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from datetime import datetime

from services.study.exceptions import NotNow
from services.study.instruments.instrument import Instrument
from services.study.page import acts
from services.study.page.order import form_order
from services.study.page.trials import Trials
from services.study.personal import Personal
from services.study.session.conductor import Conductor
from services.study.session.course import Adapt, Agree, Fill, Part, Rest, Train
from services.study.session.sheet import Sheet


class Desk:
    """Of one study.

    Attributes:
        conductor: of the study.
        instruments: its questionnaires, by their names.
        trials: what runs them.
        utc: the time of day.
        personal: what is kept of participants beside the journal.
        synthetic: nobody takes part: whoever is enrolled is marked as simulated.
        lock: held by whoever acts through the conductor.

    Args:
        conductor: of the study.
        instruments: its questionnaires, by their names.
        trials: what runs them.
        utc: the time of day.
        personal: what is kept of participants beside the journal.
        synthetic: nobody takes part: whoever is enrolled is marked as simulated.
    """

    def __init__(
        self,
        conductor: Conductor,
        instruments: Mapping[str, Instrument],
        trials: Trials,
        utc: Callable[[], datetime],
        personal: Personal,
        *,
        synthetic: bool = False,
    ) -> None:
        self.conductor = conductor
        self.instruments = instruments
        self.trials = trials
        self.utc = utc
        self.personal = personal
        self.synthetic = synthetic
        self.lock = threading.RLock()

    def participant_does(self, number: int, act: acts.ParticipantAct) -> None:
        """A participant has done something.

        Raises:
            ServiceError: it does not count, and why.
        """
        with self.lock:
            match act:
                case acts.Consent(version=version, language=language):
                    self._consent(number, version, language)
                case acts.Fill():
                    self._fill(number, act)
                case acts.Begin(part=part, language=language):
                    self._begin(number, self._at(number, part), language)
                case acts.EndBreak(part=part):
                    self._end_break(number, self._at(number, part))
                case acts.Withdraw(delete=delete):
                    self._withdraw(number, delete=delete)
            self.settle(number)

    def console_does(self, act: acts.ConsoleAct) -> None:
        """The experimenter has done something.

        Raises:
            ServiceError: it does not count, and why.
        """
        with self.lock:
            match act:
                case acts.Enrol(number=number, language=language, name=name):
                    self._enrol(number, language, name.strip())
                case acts.Pause(number=number, reason=reason):
                    self._pause(number, reason)
                case acts.GoOn(number=number, part=part, anew=anew):
                    self._go_on(number, self._at(number, part), anew=anew)
                case acts.Invalid(number=number, part=part, reason=reason, repeat=repeat):
                    self._invalid(number, part, reason, repeat=repeat)
                case acts.Note(number=number, text=text):
                    self._note(number, text)
                case acts.Abort(number=number, reason=reason):
                    self.conductor.drop(number, reason)
                    self._stop(number, "their session was ended by the experimenter")
                case acts.WithdrawFor(number=number, delete=delete):
                    self._withdraw(number, delete=delete)

    def settle(self, number: int) -> None:
        """A break begins when it comes."""
        with self.lock:
            known = self.conductor.participant(number)
            part = self.conductor.now(number)
            if isinstance(part, Rest) and known.begun != part.name and not known.paused:
                self.conductor.begin(number)

    def age(self, number: int) -> float:
        """Since a participant's last checkpoint [s]."""
        return max(0.0, self.conductor.age(number, self.utc()))

    def is_old(self, number: int) -> bool:
        """The checkpoint is older than the protocol lets go on from without the experimenter."""
        return self.age(number) > 60.0 * self.conductor.protocol.resume.minutes

    def left_s(self, number: int, rest: Rest) -> float:
        """Of a break [s]."""
        known, minutes = self.conductor.participant(number), self.conductor.protocol.breaks.minutes
        if known.begun != rest.name:
            return 60.0 * minutes
        gone = (self.utc() - datetime.fromisoformat(known.begun_at)).total_seconds()
        return min(60.0 * minutes, max(0.0, 60.0 * minutes - gone))

    def order(self, number: int, part: Fill) -> tuple[str, ...]:
        """In which the questions of a form are asked."""
        seed = self.conductor.protocol.order.seed
        return form_order(self.instruments[part.instrument], seed, number, part.name)

    def _enrol(self, number: int, language: str, name: str) -> None:
        self.conductor.enrol(number, language, synthetic=self.synthetic)
        if name:
            self.personal.name(number, name)

    def _at(self, number: int, name: str) -> Part:
        """The part that a participant is at, if it is the one of that name.

        Raises:
            NotNow: it is not.
        """
        part = self.conductor.now(number)
        if part is None or part.name != name:
            raise NotNow(f"participant {number} is not at {name} any more")
        return part

    def _consent(self, number: int, version: str, language: str) -> None:
        text = self.conductor.protocol.consent
        if version != text.version:
            raise NotNow(f"version {version} of the text was shown, the study has {text.version}: load the page anew")
        self._at(number, Agree().name)
        self._keeps_on(number)
        self.conductor.consent(number, language)

    def _fill(self, number: int, act: acts.Fill) -> None:
        part = self._at(number, act.part)
        if not isinstance(part, Fill):
            raise NotNow(f"{part.name} is no questionnaire")
        self.conductor.speaks(act.language)
        self._keeps_on(number)
        shown = [name for name in self.order(number, part) if name in act.answers]
        self.conductor.answer(number, part, Sheet(act.language, act.version, shown, act.answers))

    def _begin(self, number: int, part: Part, language: str) -> None:
        if not isinstance(part, Train | Adapt):
            raise NotNow(f"{part.name} is neither a training nor a model")
        self.conductor.speaks(language)
        self._keeps_on(number)
        self._free_for(number)
        if self.conductor.participant(number).begun == part.name:
            self.conductor.go_on(number, self.utc(), language=language)
        else:
            self.conductor.begin(number, language)
        self.trials.start(number, part, language)

    def _end_break(self, number: int, part: Part) -> None:
        if not isinstance(part, Rest):
            raise NotNow(f"{part.name} is no break")
        self._keeps_on(number)
        left_s = self.left_s(number, part)
        if left_s > 0.0:
            raise NotNow(f"the break lasts {left_s:.0f} seconds more")
        self.conductor.end(number, part)

    def _withdraw(self, number: int, *, delete: bool) -> None:
        end = self.conductor.participant(number).end
        if end == "deleted" or (end == "withdrawn" and not delete):
            raise NotNow(f"participant {number} has withdrawn already")
        self._stop(number, "the participant has withdrawn")
        self.conductor.withdraw(number, delete=delete)
        if delete:
            self.personal.delete(number)

    def _pause(self, number: int, reason: str) -> None:
        known = self.conductor.participant(number)
        if known.paused or known.gone or known.finished:
            raise NotNow(f"participant {number} pauses already, or is through, or gone")
        self._stop(number, "interrupted by the experimenter")
        self.conductor.pause(number, reason.strip())

    def _go_on(self, number: int, part: Part, *, anew: bool) -> None:
        known = self.conductor.participant(number)
        runs = isinstance(part, Train | Adapt) and known.begun == part.name
        live = self.trials.live()
        if not known.paused and (not runs or (live is not None and live.number == number)):
            raise NotNow(f"participant {number} was not interrupted")
        if runs:
            self._free_for(number)
        by_hand = self.is_old(number)
        if anew and part.name in known.attempts:
            self.conductor.invalid(number, part.name, "begun anew after an interruption", repeat=True)
        self.conductor.go_on(number, self.utc(), by_hand=by_hand)
        if runs and isinstance(part, Train | Adapt):
            self.trials.start(number, part, known.language)

    def _invalid(self, number: int, part: str, reason: str, *, repeat: bool) -> None:
        live = self.trials.live()
        runs = live.part if live is not None and live.number == number else ""
        if repeat and runs not in ("", part):
            raise NotNow(f"{runs} of participant {number} runs: interrupt it first, or wait for its end")
        self.conductor.invalid(number, part, reason, repeat=repeat)
        if runs == part:
            self.trials.stop("declared invalid")
        self.settle(number)

    def _note(self, number: int | None, text: str) -> None:
        if not text.strip():
            raise NotNow("write something first")
        self.conductor.note(number, text.strip())

    def _stop(self, number: int, why: str) -> None:
        live = self.trials.live()
        if live is not None and live.number == number:
            self.trials.stop(why)

    def _keeps_on(self, number: int) -> None:
        if self.conductor.participant(number).paused:
            raise NotNow(f"participant {number} pauses: the experimenter lets it go on")

    def _free_for(self, number: int) -> None:
        """One trial runs at a time.

        Raises:
            NotNow: another one does.
        """
        live = self.trials.live()
        if live is not None:
            whose = "it" if live.number == number else f"one of participant {live.number}"
            raise NotNow(f"{whose} runs already")
