"""Tries a model's predictions at many places, on all cores; and lets the scripted operator correct it once."""

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
from lfd.store.database import DemonstrationStore, StoredDemonstration
from services.bus.arrays import vector3
from services.offline.pool import Progress, each, overall
from services.offline.rehearsal import Plan, Rehearsal
from services.offline.result import Arrangement
from services.offline.rollout import rollout
from services.offline.steering import steered
from services.robot.arm import Arm
from services.robot.assembly import simulated_arm
from services.robot.starts import StartImpossible
from services.robot.verdict import Verdict
from services.success_map.conditions import UNREACHABLE, Condition, Ending, Setting, Trial
from sim.robots.description import prepare
from sim.tasks import REACHING
from sim.tasks.scene import ReachingScene

REFINEMENTS_ALLOWED = 10


@dataclass(frozen=True, eq=False)
class Tried:
    """What is to be tried.

    Attributes:
        scene: by name, of those in which an arm reaches for an object.
        variant: of the scene.
        models: the stages of a model.
        places: where each of them is tried.
    """

    scene: str
    variant: str
    models: tuple[MovementModel, ...]
    places: tuple[Setting, ...]


def conditions(task: Tried, jobs: int, progress: Progress = lambda _: None) -> list[Condition]:
    """Try the models at all places.

    A place is unreachable where no motion can start, or where nothing that was tried succeeded and the scene's own
    safe way fails too, steered with a steady hand: that the arm has no joint positions at the object is one reason.
    The models know exactly where the object is.

    Args:
        task: everything.
        jobs: processes at most.
        progress: of the work.

    Returns:
        What became of each place, in their order.
    """
    parts = max(1, min(jobs, len(task.places)))
    tasks = [Tried(task.scene, task.variant, task.models, task.places[i::parts]) for i in range(parts)]
    found: list[tuple[Trial, ...]] = [()] * len(task.places)
    for part, trials in each(_carry_out, tasks, parts, overall(parts, progress)):
        found[part::parts] = trials
    return [Condition(place, trials) for place, trials in zip(task.places, found, strict=True)]


def corrected_once(
    scene: ReachingScene, variant: str, kind: str, demonstrations: Sequence[Demonstration], seed: int
) -> list[StoredDemonstration]:
    """Let the scripted operator correct a model once: where the first of the scene's training positions fails.

    Robot, master, model and station are the real ones, so the correction is what a person at this desk would give.

    Args:
        scene: where.
        variant: of the scene.
        kind: of the model.
        demonstrations: that it starts from.
        seed: of the operator's tremor.

    Returns:
        All that the model has learnt; without a correction where every prediction succeeded.

    Raises:
        ServiceError: the services cannot be built, or refuse a demonstration.
    """
    plan = Plan(scene.name, kind, tuple(demonstrations), (), seed=seed, updates_allowed=1)
    with tempfile.TemporaryDirectory(prefix="map-") as folder, threadpool_limits(1):
        database = Path(folder) / "model.sqlite"
        rehearsal = Rehearsal(plan, database)
        try:
            rehearsal.learn(demonstrations)
            for position in scene.training_positions:
                if rehearsal.course(Arrangement(variant, vector3(position)), REFINEMENTS_ALLOWED).updates:
                    break
        finally:
            rehearsal.close()
        with DemonstrationStore(database) as store:
            return store.active()


def _carry_out(task: Tried, progress: Progress) -> list[tuple[Trial, ...]]:
    scene, found = REACHING[task.scene], list[tuple[Trial, ...]]()
    with threadpool_limits(1):
        arm = simulated_arm(scene, task.variant, prepare())
        for place in task.places:
            found.append(_tried(arm, scene, task, place))
            progress(len(found) / len(task.places))
    return found


def _tried(arm: Arm, scene: ReachingScene, task: Tried, place: Setting) -> tuple[Trial, ...]:
    start, position = place.start(scene), np.array(place.object_position)
    situation = Situation.reaching(position, start.position, start.orientation)

    def verdict(motion: Trajectory) -> Verdict:
        return rollout(arm, motion, position, variant=task.variant, start=start, to_collision=True).verdict

    try:
        trials = [_trial(verdict(model.predict(situation).trajectory)) for model in task.models]
    except StartImpossible:
        return (UNREACHABLE,) * len(task.models)
    proven = any(trial.outcome is Ending.REACHED for trial in trials)
    possible = proven or verdict(steered(scene.corridor(task.variant, position, start), None, scene.freedom)).success
    return tuple(trials) if possible else (UNREACHABLE,) * len(trials)


def _trial(verdict: Verdict) -> Trial:
    if verdict.collision is not None:
        return Trial(Ending.COLLISION, verdict.collision.between)
    if verdict.kicked_over:
        return Trial(Ending.KICKED_OVER)
    return Trial(Ending.REACHED if verdict.reached else Ending.NOT_REACHED)
