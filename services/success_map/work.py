"""Tries models' predictions at many places, on all cores; and lets scripted operators correct them first."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits

from lfd.models.model import MovementModel
from lfd.motion.demonstration import Demonstration, Situation
from lfd.motion.trajectory import Trajectory
from lfd.store.database import DemonstrationStore
from lfd.store.stored import StoredDemonstration
from services.offline.pool import Progress, each, overall
from services.offline.rehearsal import Plan, Rehearsal
from services.offline.result import Arrangement
from services.offline.rollout import rollout
from services.offline.steering import steered
from services.robot.arm import Arm
from services.robot.assembly import simulated_arm
from services.robot.starts import StartImpossible
from services.robot.verdict import Verdict
from services.success_map.conditions import UNREACHABLE, Array, Condition, Ending, Setting, Target, Trial
from sim.pose import Pose
from sim.tasks import AnyScene, described
from sim.tasks import scene as find_scene

REFINEMENTS_ALLOWED = 10


@dataclass(frozen=True, eq=False)
class Tried:
    """What is to be tried.

    Attributes:
        scene: by name.
        variant: of the scene.
        people: the stages of each person's model; the models take turns at the settings.
        settings: where they are tried.
    """

    scene: str
    variant: str
    people: tuple[tuple[MovementModel, ...], ...]
    settings: tuple[Setting, ...]


@dataclass(frozen=True, eq=False)
class Lesson:
    """What one scripted operator is to correct.

    Attributes:
        scene: by name.
        variant: of the scene.
        kind: of the model.
        demonstrations: that it starts from.
        targets: places to go through, in their order, once at each.
        corrections: at how many of them a correction is given at most.
        seed: of the operator.
        scatter: of the operator, see `Scripted` [m].
    """

    scene: str
    variant: str
    kind: str
    demonstrations: tuple[Demonstration, ...]
    targets: tuple[Target, ...]
    corrections: int
    seed: int
    scatter: float


@dataclass(frozen=True, eq=False)
class Learnt:
    """What came of a lesson.

    Attributes:
        stored: all that the model has learnt; no correction where every prediction succeeded.
        corrected: places of the corrections, in their order.
    """

    stored: tuple[StoredDemonstration, ...]
    corrected: tuple[Target, ...]


def conditions(task: Tried, jobs: int, progress: Progress = lambda _: None) -> list[Condition]:
    """Try the models at all settings.

    A setting is unreachable where no motion can start, or where nothing that was tried succeeded and the scene's own
    safe ways fail too, steered with a steady hand: that the arm has no joint positions at the object is one reason.
    The models know exactly where the target is.

    Args:
        task: everything.
        jobs: processes at most.
        progress: of the work.

    Returns:
        What became of each setting, in their order.
    """
    turns = [(setting, task.people[i % len(task.people)]) for i, setting in enumerate(task.settings)]
    parts = max(1, min(jobs, len(turns)))
    pieces = [_Part(task.scene, task.variant, tuple(turns[i::parts])) for i in range(parts)]
    found: list[tuple[Trial, ...]] = [()] * len(turns)
    for part, trials in each(_carry_out, pieces, parts, overall(parts, progress)):
        found[part::parts] = trials
    return [Condition(setting, trials) for setting, trials in zip(task.settings, found, strict=True)]


def taught(lessons: Sequence[Lesson], jobs: int) -> list[Learnt]:
    """Let scripted operators correct a model each.

    Robot, master, model and station are the real ones, so a correction is what a person at this desk would give.

    Args:
        lessons: one for each of them.
        jobs: processes at most.

    Raises:
        ServiceError: the services cannot be built, or refuse a demonstration.
    """
    done = dict(each(_teach, lessons, jobs))
    return [done[number] for number in range(len(lessons))]


def _teach(lesson: Lesson, progress: Progress) -> Learnt:
    plan = Plan(
        lesson.scene,
        lesson.kind,
        lesson.demonstrations,
        (),
        seed=lesson.seed,
        scatter=lesson.scatter,
        updates_allowed=1,
    )
    has_object = find_scene(lesson.scene).has_object
    corrected: list[Target] = []
    with tempfile.TemporaryDirectory(prefix="map-") as folder, threadpool_limits(1):
        database = Path(folder) / "model.sqlite"
        rehearsal = Rehearsal(plan, database)
        try:
            rehearsal.learn(lesson.demonstrations)
            for number, target in enumerate(lesson.targets, 1):
                arranged = Arrangement.of(lesson.variant, target, has_object=has_object)
                if rehearsal.course(arranged, REFINEMENTS_ALLOWED).updates:
                    corrected.append(target)
                progress(number / len(lesson.targets))
                if len(corrected) == lesson.corrections:
                    break
        finally:
            rehearsal.close()
        with DemonstrationStore(database) as store:
            return Learnt(tuple(store.active()), tuple(corrected))


@dataclass(frozen=True, eq=False)
class _Part:
    """What one process tries: settings, each with the stages of the model whose turn it is."""

    scene: str
    variant: str
    turns: tuple[tuple[Setting, tuple[MovementModel, ...]], ...]


def _carry_out(part: _Part, progress: Progress) -> list[tuple[Trial, ...]]:
    scene, found = find_scene(part.scene), list[tuple[Trial, ...]]()
    with threadpool_limits(1):
        arm = simulated_arm(scene, part.variant, described(scene))
        for setting, models in part.turns:
            found.append(_tried(arm, scene, part.variant, setting, models))
            progress(len(found) / len(part.turns))
    return found


def _tried(
    arm: Arm, scene: AnyScene, variant: str, setting: Setting, models: tuple[MovementModel, ...]
) -> tuple[Trial, ...]:
    start, target = setting.start(scene), np.array(setting.target)
    situation = _situation(scene, target, start)

    def verdict(motion: Trajectory) -> Verdict:
        return rollout(arm, motion, target, variant=variant, start=start, to_collision=True).verdict

    try:
        trials = [_trial(verdict(model.predict(situation).trajectory)) for model in models]
    except StartImpossible:
        return (UNREACHABLE,) * len(models)
    ways = scene.corridors(variant, target, start)
    possible = any(trial.outcome is Ending.REACHED for trial in trials) or any(
        verdict(steered(way, None, scene.freedom)).success for way in ways
    )
    return tuple(trials) if possible else (UNREACHABLE,) * len(trials)


def _situation(scene: AnyScene, target: Array, start: Pose) -> Situation:
    if scene.has_object:
        return Situation.reaching(target, start.position, start.orientation)
    return Situation(target, np.zeros(3), start.position, start.orientation)


def _trial(verdict: Verdict) -> Trial:
    if verdict.collision is not None:
        return Trial(Ending.COLLISION, verdict.collision.between)
    if verdict.kicked_over:
        return Trial(Ending.KICKED_OVER)
    return Trial(Ending.REACHED if verdict.reached else Ending.NOT_REACHED)
