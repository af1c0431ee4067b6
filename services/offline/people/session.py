"""One person's session: a skill that fails, taught once by one method and device, then executed by the robot alone."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from threadpoolctl import threadpool_limits

from lfd.motion.demonstration import Demonstration
from protocol.messages import EpisodeResult, Mode
from protocol.topics import EPISODE_RESULT
from services.offline.people.person import Character, Person
from services.offline.people.ways import Device, Teaching
from services.offline.pool import Progress, each, overall
from services.offline.result import Arrangement
from services.offline.stage import Stage, give
from services.process.config import Configuration, MasterSection, ModelSection, RobotSection
from services.process.master_devices import Page, Scripted

TRIES = 3
"""At one update: whose hand missed tries again, as people did."""

LONGEST_S = 600.0
"""Of a session, of the robot's time."""


@dataclass(frozen=True, eq=False)
class Session:
    """Who teaches what, and how.

    Attributes:
        scene: by name.
        demonstrations: that the skill starts from.
        arrangement: in which it fails.
        teaching: how it is taught.
        device: by which the person leads.
        seed: of the person, and of the eyes' error.
        scatter: of the person, see `Scripted` [m].
    """

    scene: str
    demonstrations: tuple[Demonstration, ...]
    arrangement: Arrangement
    teaching: Teaching
    device: Device
    seed: int
    scatter: float = Scripted().scatter

    def configuration(self, database: Path) -> Configuration:
        """Of the services."""
        return Configuration(
            seed=self.seed,
            robot=RobotSection(scene=self.scene),
            master=led_by(self.device, self.scatter),
            model=ModelSection(database=str(database)),
        )


@dataclass(frozen=True)
class Taught:
    """What came of a session.

    Attributes:
        adapted: after one update the robot alone succeeded.
        learnt: there was an update.
        tries: attempts at it.
        seconds: from the first press until it was learnt, of the robot's time [s].
        why: what went wrong, the newest first; empty where nothing did.
    """

    adapted: bool
    learnt: bool
    tries: int
    seconds: float
    why: tuple[str, ...] = ()


def taught(session: Session, progress: Progress = lambda _: None) -> Taught:
    """Let the person teach, in this process.

    Raises:
        ServiceError: the services cannot be built, or refuse a demonstration.
    """
    del progress
    with prepared(session.configuration, session.demonstrations) as stage:
        return _watched(stage, session)


@contextmanager
def prepared(
    configuration: Callable[[Path], Configuration], demonstrations: Sequence[Demonstration]
) -> Iterator[Stage]:
    """A stage whose model starts from demonstrations, for as long as it is needed.

    Args:
        configuration: of the services, from where the model's database is.
        demonstrations: in the base frame.

    Raises:
        ServiceError: the services cannot be built, or refuse a demonstration.
    """
    with tempfile.TemporaryDirectory(prefix="session-") as folder, threadpool_limits(1):
        configured = configuration(Path(folder) / "model.sqlite")
        stage = Stage(configured)
        try:
            give(stage, configured.robot.scene, demonstrations)
            yield stage
        finally:
            stage.close()


def led_by(device: Device, scatter: float) -> MasterSection:
    """The master of who leads by a device: the stylus is a script's, all others are the page's.

    Args:
        device: that they lead by.
        scatter: of the person, see `Scripted` [m].
    """
    return MasterSection(device=Scripted(scatter=scatter) if device is Device.STYLUS else Page())


def all_taught(sessions: Sequence[Session], jobs: int, progress: Progress = lambda _: None) -> list[Taught]:
    """Every session, on as many cores; raises as `taught`."""
    done = dict(each(taught, sessions, jobs, overall(len(sessions), progress)))
    return [done[number] for number in range(len(sessions))]


def _watched(stage: Stage, session: Session) -> Taught:
    character = Character(session.seed, session.scatter, Scripted().misjudgement)
    bus = stage.bus()
    person = Person(bus, stage.clock, session.teaching, session.device, character)
    results = bus.subscribe(EPISODE_RESULT)
    seen: list[EpisodeResult] = []
    began, learnt_at = stage.clock.now_ns(), 0

    def over() -> bool:
        nonlocal learnt_at
        now_ns = stage.clock.now_ns()
        seen.extend(received.message for received in results.take())
        teaching = person.teaching
        if teaching is None:
            return False
        if teaching.updates and not learnt_at:
            learnt_at = now_ns
        alone = teaching.updates and teaching.attempts and teaching.attempts[-1].model_version >= _version(session) + 1
        tired = not teaching.updates and len(teaching.attempts) >= TRIES and teaching.phase == "deciding"
        return bool(alone or tired or teaching.finished or now_ns - began > LONGEST_S * 1e9)

    stage.sit(person, session.arrangement.reset(), over)
    teaching = person.teaching
    attempts = teaching.attempts if teaching is not None else ()
    updates = teaching.updates if teaching is not None else 0
    last = attempts[-1] if updates and attempts else None
    adapted = last is not None and last.mode is Mode.AUTONOMOUS and last.verdict.success
    tries = sum(attempt.mode is not Mode.AUTONOMOUS for attempt in attempts)
    seconds = (learnt_at - began) / 1e9 if learnt_at else 0.0
    return Taught(adapted, updates > 0, tries, seconds, () if adapted else _why(seen))


def _version(session: Session) -> int:
    return len(session.demonstrations)


def _why(results: Sequence[EpisodeResult]) -> tuple[str, ...]:
    """Of each motion that failed, in few words."""
    said = []
    for result in reversed(results):
        verdict = result.verdict
        wrong = [
            *(
                ["hit " + " and ".join(verdict.collision_between)]
                if verdict.collision and verdict.collision_between
                else []
            ),
            *(["kicked it over"] if verdict.kicked_over else []),
            *(["did not reach it"] if not verdict.reached else []),
            *([result.reason] if result.reason else []),
        ]
        said.append(f"{result.mode.value}: {', '.join(wrong) or 'fine'}")
    return tuple(said)
