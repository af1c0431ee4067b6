"""Synthetic participants go through a whole study: faster than real time, on all cores, resumed wherever it ended.

All that happens follows from the protocol and one seed, and is written in one order, whatever was ready first and
however often the run was killed: the journals of two runs with one seed are the same to the byte, but for where they
were opened. Nothing of a participant's method is in the journal before all of it was done, and what a killed run had
written of it is not written again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta

from services.offline.first_demonstrations import first_demonstrations
from services.offline.pool import ProcessDied, Progress, each
from services.study.arrangement import arrangement
from services.study.instruments.instrument import Instrument
from services.study.protocol.protocol import Protocol
from services.study.session.conductor import Conductor
from services.study.session.course import Adapt, Agree, Fill, Part, Participant, Rest, Train
from services.study.session.sheet import Sheet
from services.study.synthetic.character import Nature
from services.study.synthetic.filling import Experience, filled
from services.study.synthetic.lesson import Done, Lesson, given
from services.study.synthetic.rehearsal import Rehearsal
from sim.tasks import AnyScene
from sim.tasks import scene as scene_named

BEGIN = datetime(2000, 1, 1, 9, tzinfo=UTC)
"""When synthetic studies take place: at a time at which nobody takes them for a real one."""

READING_S = 120.0
"""That a form or the consent takes."""

DEATHS = 5
"""So many processes of the pool may be killed before the run gives up."""


Lessons = Callable[[Sequence[Lesson], int], Iterator[tuple[tuple[int, str], tuple[Done, ...]]]]
"""Gives lessons with so many processes; of each, whose and by which method, and what came of it, in any order."""


@dataclass
class StudyClock:
    """The time of day in the study: it goes on with what is done, not with the computer."""

    now: datetime = BEGIN

    def __call__(self) -> datetime:
        """The time of day."""
        return self.now

    def passes(self, seconds: float) -> None:
        """Something took a while."""
        self.now += timedelta(seconds=seconds)


@dataclass(eq=False)
class SyntheticRun:
    """Of one study.

    Attributes:
        protocol: of the study.
        instruments: that it names.
        conductor: of the study.
        clock: of the journal.
        rehearsal: who takes part.
        lessons: gives them.
    """

    protocol: Protocol
    instruments: Mapping[str, Instrument]
    conductor: Conductor
    clock: StudyClock
    rehearsal: Rehearsal
    lessons: Lessons = field(default_factory=lambda: simulated)
    _done: dict[tuple[int, str], dict[str, Done]] = field(default_factory=dict)

    def go(self, jobs: int, progress: Progress = lambda _: None) -> None:
        """Do all that is not done yet.

        Args:
            jobs: processes at most.
            progress: is told how it goes on.

        Raises:
            ProcessDied: processes of the pool were killed again and again.
            ServiceError: the services cannot be built.
        """
        scene = scene_named(self.protocol.task.scene)
        self.rehearsal.enrol(self.conductor)
        missing = list(self._missing(scene))
        total = self.rehearsal.people * len(self.protocol.methods)
        self._write_on()
        for ready, (key, parts) in enumerate(self.lessons(missing, jobs), 1):
            self._done[key] = {done.part: done for done in parts}
            self._write_on()
            progress((total - len(missing) + ready) / total)

    def _missing(self, scene: AnyScene) -> Iterator[Lesson]:
        """Lessons of which something is not in the journal."""
        demonstrations = tuple(first_demonstrations(scene))
        for one in self._participants():
            left = {part.method for part in one.left(self.protocol) if isinstance(part, Train | Adapt)}
            for place, name in enumerate(one.enrolled.order, 1):
                if name in left:
                    yield Lesson(
                        one.number,
                        Nature.drawn(one.enrolled.seed),
                        self.protocol.method(name),
                        place,
                        self.protocol.task,
                        self.protocol.training,
                        demonstrations,
                        arrangement(self.protocol, scene),
                    )

    def _participants(self) -> list[Participant]:
        return [one for number, one in sorted(self.conductor.participants().items()) if number <= self.rehearsal.people]

    def _write_on(self) -> None:
        """Write as far as everything before is there."""
        for one in self._participants():
            while (part := self.conductor.now(one.number)) is not None:
                if not self._written(one, part):
                    return

    def _written(self, one: Participant, part: Part) -> bool:
        """Write a part down; whether it was there to be written."""
        match part:
            case Agree():
                self.clock.passes(READING_S)
                self.conductor.consent(one.number, one.enrolled.language)
            case Fill():
                self.clock.passes(READING_S)
                self.conductor.answer(one.number, part, self._sheet(one, part))
            case Rest():
                self.clock.passes(60.0 * self.protocol.breaks.minutes)
                self.conductor.end(one.number, part)
            case Train() | Adapt():
                done = self._done.get((one.number, part.method), {}).get(part.name)
                if done is None:
                    return False
                self._attempted(one, part, done)
        return True

    def _attempted(self, one: Participant, part: Train | Adapt, done: Done) -> None:
        known = one.attempts.get(part.name, ())
        began = self.clock.now - timedelta(seconds=known[-1].ended if known else 0.0)
        if one.begun != part.name:
            self.conductor.begin(one.number)
        for attempt in done.attempts:
            self.clock.now = max(self.clock.now, began + timedelta(seconds=attempt.ended))
            self.conductor.attempted(attempt)
        self.clock.now = began + timedelta(seconds=done.lasted)
        self.conductor.end(one.number, part, passed=done.passed, seconds=done.seconds)

    def _sheet(self, one: Participant, part: Fill) -> Sheet:
        instrument = self.instruments[part.instrument]
        nature = Nature.drawn(one.enrolled.seed)
        number = len(one.answers)
        shown, answers = filled(instrument, nature, number, experience(one, part.after) if part.after else None)
        return Sheet(one.enrolled.language, instrument.version, shown, answers)


def experience(one: Participant, method: str) -> Experience:
    """What a method was to a participant."""
    of = [attempts for name, attempts in one.attempts.items() if name.partition("/")[0] == method]
    led = [attempt for attempts in of for attempt in attempts if attempt.teaching is not None]
    failed = sum(not attempt.success for attempt in led) / len(led) if led else 1.0
    return Experience(sum(attempt.active for attempt in led), failed)


def simulated(lessons: Sequence[Lesson], jobs: int) -> Iterator[tuple[tuple[int, str], tuple[Done, ...]]]:
    """In the simulator, see `Lessons`; one whose process was killed is given again.

    Raises:
        ProcessDied: processes were killed again and again.
    """
    left = list(lessons)
    deaths = 0
    while left:
        finished: set[int] = set()
        try:
            for number, parts in each(given, left, jobs):
                finished.add(number)
                yield (left[number].participant, left[number].method.name), parts
        except ProcessDied:
            deaths += 1
            if deaths > DEATHS:
                raise
        left = [lesson for number, lesson in enumerate(left) if number not in finished]
