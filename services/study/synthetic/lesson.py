"""One method with one synthetic participant: training and all models, in the simulator, as fast as it can."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from lfd.motion.demonstration import Demonstration
from services.offline.people.person import Character, Person
from services.offline.people.session import led_by, prepared
from services.offline.pool import Progress
from services.offline.result import Arrangement
from services.offline.stage import Stage
from services.process.config import Configuration, ModelSection, RobotSection, StationSection
from services.study.events import Attempted
from services.study.protocol.protocol import Method, Task, Training
from services.study.session.rules import adapted, trained
from services.study.session.watch import Watch
from services.study.synthetic.character import Nature

LONGEST_S = 600.0
"""Of a part, of the robot's time [s]."""

METHOD_H = 0.4
"""That a method takes, as people tire [h]."""

PERIOD_NS = 10_000_000
"""Between two looks at the robot."""


@dataclass(frozen=True, eq=False)
class Lesson:
    """What is done.

    Attributes:
        participant: number.
        nature: theirs.
        method: with which.
        place: of the method in their order, from 1.
        task: of the protocol.
        training: of the protocol.
        demonstrations: that each model starts from.
        arrangement: that the robot finds.
    """

    participant: int
    nature: Nature
    method: Method
    place: int
    task: Task
    training: Training
    demonstrations: tuple[Demonstration, ...]
    arrangement: Arrangement

    def configuration(self, seed: int, scatter: float, database: Path) -> Configuration:
        """Of the services."""
        return Configuration(
            seed=seed,
            robot=RobotSection(scene=self.task.scene),
            master=led_by(self.method.device, scatter),
            model=ModelSection(database=str(database)),
            station=StationSection(
                refinements_allowed=self.task.refinements, updates_allowed=self.task.updates, once=True
            ),
        )


@dataclass(frozen=True)
class Done:
    """One part of it.

    Attributes:
        part: its name.
        attempts: in their order.
        passed: the training was, or the model was adapted.
        seconds: that the operator could act [s].
        lasted: from begin to end [s].
    """

    part: str
    attempts: tuple[Attempted, ...]
    passed: bool
    seconds: float
    lasted: float


Over = Callable[[Sequence[Attempted]], bool]
"""Whether a round is, by its attempts so far."""


def given(lesson: Lesson, progress: Progress = lambda _: None) -> tuple[Done, ...]:
    """The training, and where it is passed all models.

    Raises:
        ServiceError: the services cannot be built, or refuse a demonstration.
    """
    parts = [_trained(lesson)]
    for model in range(1, lesson.task.models + 1) if parts[0].passed else ():
        progress(model / (1 + lesson.task.models))
        one = _Round(f"{lesson.method.name}/{model}", model)
        parts.append(_taught(lesson, one, lambda attempts: adapted(attempts, lesson.task) is not None))
    progress(1.0)
    return tuple(parts)


@dataclass(frozen=True)
class _Round:
    """With one model, from its first demonstrations.

    Attributes:
        part: whose name.
        number: no two of a method are the same.
        known: attempts of the part in rounds before.
        lasted: these rounds [s].
    """

    part: str
    number: int
    known: int = 0
    lasted: float = 0.0


def _trained(lesson: Lesson) -> Done:
    """Round after round, until enough of the last attempts succeeded."""
    rule, name = lesson.training, f"{lesson.method.name}/training"
    attempts: list[Attempted] = []
    seconds = lasted = 0.0
    while (passed := trained(attempts, rule, lasted)) is None:
        done = _taught(lesson, _Round(name, 100 + len(attempts), len(attempts), lasted), _succeeded)
        if not done.attempts:
            break
        attempts += done.attempts
        seconds, lasted = seconds + done.seconds, lasted + done.lasted
    return Done(name, tuple(attempts), passed is True, round(seconds, 3), round(lasted, 3))


def _succeeded(attempts: Sequence[Attempted]) -> bool:
    """They have, once."""
    return any(attempt.success for attempt in attempts if attempt.teaching is not None)


def _taught(lesson: Lesson, one: _Round, over: Over) -> Done:
    hours = (lesson.place - 1) * METHOD_H
    who = lesson.nature.character(hours, 1000 * lesson.place + one.number)
    with prepared(partial(lesson.configuration, who.seed, who.scatter), lesson.demonstrations) as stage:
        return _watched(stage, lesson, one, who, over)


def _watched(stage: Stage, lesson: Lesson, one: _Round, who: Character, over: Over) -> Done:
    person = Person(stage.bus(), stage.clock, lesson.method.teaching, lesson.method.device, who)
    watch = Watch(stage.bus(), lesson.participant, one.part, lesson.method.teaching, known=one.known, lasted=one.lasted)
    began = looked = stage.clock.now_ns()

    def finished() -> bool:
        nonlocal looked
        now_ns = stage.clock.now_ns()
        if now_ns - looked >= PERIOD_NS:
            looked = now_ns
            watch.step(now_ns)
        seen = watch.told
        return seen is not None and (over(watch.attempts) or seen.finished or now_ns - began > LONGEST_S * 1e9)

    stage.sit(person, lesson.arrangement.reset(), finished)
    passed = bool(watch.attempts) and watch.attempts[-1].success
    seconds = sum(attempt.active for attempt in watch.attempts)
    lasted = (stage.clock.now_ns() - began) / 1e9
    return Done(one.part, tuple(watch.attempts), passed, round(seconds, 3), round(lasted, 3))
