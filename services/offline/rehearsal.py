"""Teaches a list of conditions one after another, and executes them all again without teaching."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from lfd.motion.demonstration import Demonstration
from protocol.messages import EpisodeResult, TeachingState
from protocol.topics import EPISODE_RESULT, TEACHING_STATE
from services.bus.arrays import from_wire
from services.bus.predictions import Predictions
from services.model.learning import MODELS, Fit
from services.offline.pool import Progress, each, overall
from services.offline.result import Arrangement, Attempt, Course
from services.offline.stage import Stage, give
from services.process.config import Configuration, MasterSection, ModelSection, RobotSection, StationSection
from services.process.exceptions import CommandFailed
from services.process.master_devices import Scripted
from sim.tasks import AnyScene
from sim.tasks import scene as find_scene


@dataclass(frozen=True, eq=False)
class Plan:
    """What to rehearse.

    Attributes:
        scene: by name.
        kind: of the model, a key of `models`.
        demonstrations: that the model starts from, in the base frame.
        taught: conditions, in the order in which Algorithm 1 goes through them.
        executed: conditions of the second round, without teaching.
        seed: of all that the operator does not mean, and of the eyes' error.
        exaggeration: of the operator's corrections; 1 is natural.
        scatter: of the operator, see `Scripted` [m].
        refinements_allowed: attempts at one update.
        updates_allowed: under one condition.
        models: to choose from.
    """

    scene: str
    kind: str
    demonstrations: tuple[Demonstration, ...]
    taught: tuple[Arrangement, ...]
    executed: tuple[Arrangement, ...] = ()
    seed: int = 0
    exaggeration: float = 1.0
    scatter: float = Scripted().scatter
    refinements_allowed: int = 10
    updates_allowed: int = 8
    models: Mapping[str, Fit] = field(default_factory=lambda: MODELS)

    def configuration(self, database: Path) -> Configuration:
        """Of the services."""
        return Configuration(
            seed=self.seed,
            robot=RobotSection(scene=self.scene),
            master=MasterSection(device=Scripted(exaggeration=self.exaggeration, scatter=self.scatter)),
            model=ModelSection(kind=self.kind, database=str(database)),
            station=StationSection(scripted=True, once=True, updates_allowed=self.updates_allowed),
        )


@dataclass(frozen=True, eq=False)
class Rehearsed:
    """What came out.

    Attributes:
        first: Algorithm 1 under each condition that was taught.
        second: each condition of the second round; one attempt each.
    """

    first: tuple[Course, ...]
    second: tuple[Course, ...]


def rehearse(plan: Plan, progress: Progress = lambda _: None) -> Rehearsed:
    """Both rounds of a plan, in this process.

    Args:
        plan: what to rehearse.
        progress: of the work.

    Raises:
        ServiceError: the services cannot be built, or refuse a demonstration.
    """
    with tempfile.TemporaryDirectory(prefix="rehearsal-") as folder:
        rehearsal = Rehearsal(plan, Path(folder) / "model.sqlite")
        try:
            rehearsal.learn(plan.demonstrations)
            total = max(1, len(plan.taught) + len(plan.executed))
            first, second = [], []
            for arrangement in plan.taught:
                first.append(rehearsal.course(arrangement, plan.refinements_allowed))
                progress(len(first) / total)
            for arrangement in plan.executed:
                second.append(rehearsal.course(arrangement, 0))
                progress((len(first) + len(second)) / total)
        finally:
            rehearsal.close()
    return Rehearsed(tuple(first), tuple(second))


def rehearse_all(plans: Sequence[Plan], jobs: int, progress: Progress = lambda _: None) -> list[Rehearsed]:
    """Independent plans, on as many cores.

    Args:
        plans: what to rehearse.
        jobs: processes at most.
        progress: of all plans together.

    Raises:
        ServiceError: as `rehearse`.
    """
    done = dict(each(rehearse, plans, jobs, overall(len(plans), progress)))
    return [done[number] for number in range(len(plans))]


class Rehearsal:
    """One robot, model and operator through any number of conditions.

    Args:
        plan: what to rehearse.
        database: file of the model.
    """

    def __init__(self, plan: Plan, database: Path) -> None:
        self._plan = plan
        self._scene = find_scene(plan.scene)
        self._stage = Stage(plan.configuration(database), plan.models)
        self._bus = self._stage.bus()
        self._predictions = Predictions(self._bus)
        self._results = self._bus.subscribe(EPISODE_RESULT)
        self._teaching = self._bus.subscribe(TEACHING_STATE)

    def learn(self, demonstrations: Sequence[Demonstration]) -> None:
        """Give the model what it starts from.

        Raises:
            CommandFailed: it does not take it.
        """
        give(self._stage, self._scene.name, demonstrations)

    def course(self, arrangement: Arrangement, refinements_allowed: int) -> Course:
        """Algorithm 1 under one condition.

        Args:
            arrangement: the condition.
            refinements_allowed: attempts at one update; 0 to execute once and not to teach.
        """
        attempts: list[Attempt] = []
        updates = 0
        self._teaching.take()

        def finished() -> bool:
            nonlocal updates
            state = self._newest()
            if state is None:
                return False
            updates = state.updates
            if len(state.attempts) > len(attempts):
                result = self._result()
                predicted = self._predictions.motion(result.prediction)
                if predicted is None:
                    raise CommandFailed("a motion was executed whose prediction nobody heard")
                miss = missed_by(self._scene, arrangement, result)
                attempts.append(Attempt.of(result, predicted, state.attempts[-1].model_version, miss))
            return state.finished

        self._stage.teach(arrangement.reset(), refinements_allowed, finished)
        return Course(arrangement, tuple(attempts), updates)

    def close(self) -> None:
        """Give back what the services hold."""
        self._stage.close()

    def _newest(self) -> TeachingState | None:
        taken = self._teaching.take()
        return taken[-1].message if taken else None

    def _result(self) -> EpisodeResult:
        received = self._results.latest()
        if received is None:
            raise CommandFailed("an episode was judged whose result nobody heard")
        return received.message


def missed_by(scene: AnyScene, arrangement: Arrangement, result: EpisodeResult) -> float:
    """How much nearer a motion should have come: to the object, along the line to it, or to the worse via-point [m].

    Args:
        scene: in which it was executed.
        arrangement: of the scene.
        result: of the episode.
    """
    # The verdict's value is the square of how many times too far it was.
    times = max(1.0, math.sqrt(result.verdict.ellipsoid_value))
    lies = arrangement.place + result.verdict.object_displacement if scene.has_object else arrangement.place
    return scene.missed_by(from_wire(result.measured.positions)[-1], lies, times)
