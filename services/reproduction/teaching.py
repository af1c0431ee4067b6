"""Both models through the same conditions: taught by Algorithm 1, then executed once more without teaching."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lfd.motion.demonstration import Demonstration
from protocol import messages
from services.bus.arrays import quaternion, vector3
from services.offline.demonstrations import demonstrate
from services.offline.rehearsal import Plan, Rehearsed, rehearse_all
from services.offline.result import Arrangement, Course
from services.reproduction.analysis import Context, Holds, Row
from services.reproduction.models import BY_NAME, CONTENDERS
from services.robot.assembly import simulated_arm
from sim.pose import Pose
from sim.robots.description import prepare
from sim.tasks import AnyScene

Array = NDArray[np.float64]

MODELS = tuple(BY_NAME)
"""The model process' names of `CONTENDERS`, in their order."""


@dataclass(frozen=True, eq=False)
class Question:
    """What is taught, and how.

    Attributes:
        scene: of all conditions.
        demonstrated: that the models start from, in the scene's first variant.
        refined: conditions that Algorithm 1 goes through.
        executed: conditions of the second round.
        beyond: conditions to which the models are to generalise after that; they are not taught either.
    """

    scene: AnyScene
    demonstrated: tuple[Arrangement, ...]
    refined: tuple[Arrangement, ...]
    executed: tuple[Arrangement, ...]
    beyond: tuple[Arrangement, ...] = ()


@dataclass(frozen=True, eq=False)
class Answer:
    """What came out, for both models in the order of `CONTENDERS`.

    Attributes:
        question: that was asked.
        demonstrations: that both models started from.
        of_kinds: both rounds of each model.
        beyond: of each model, the conditions to which it was to generalise.
    """

    question: Question
    demonstrations: tuple[Demonstration, ...]
    of_kinds: tuple[Rehearsed, ...]
    beyond: tuple[tuple[Course, ...], ...]


def arrangement(
    scene: AnyScene, variant: str, object_position: Sequence[float], offset: Sequence[float]
) -> Arrangement:
    """An arrangement whose start is moved by an offset from the scene's own [m]."""
    start = messages.Pose(vector3(scene.start.position + np.array(offset)), quaternion(scene.start.orientation))
    return Arrangement(variant, vector3(object_position), start)


def taught(scene: AnyScene, arrangements: Sequence[Arrangement], rng: np.random.Generator) -> tuple[Demonstration, ...]:
    """A demonstration under each arrangement, given in the simulator by the scripted operator.

    Raises:
        CommandFailed: no motion to some object succeeded.
        StartImpossible: no motion can start there.
    """
    arm = simulated_arm(scene, scene.variants[0], prepare())
    return tuple(
        demonstrate(arm, scene, one.place, rng, start=_pose(one.start) if one.start else None) for one in arrangements
    )


def answered(question: Question, context: Context) -> Answer:
    """Teach both models, each in a process of its own where there are several cores."""
    demonstrations = taught(question.scene, question.demonstrated, context.rng())
    executed = (*question.executed, *question.beyond)
    plans = [
        Plan(question.scene.name, model, demonstrations, question.refined, executed, seed=context.seed)
        for model in MODELS
    ]
    rehearsed = rehearse_all(plans, os.cpu_count() or 1, context.advance)
    n = len(question.executed)
    return Answer(
        question,
        demonstrations,
        tuple(replace(one, second=one.second[:n]) for one in rehearsed),
        tuple(one.second[n:] for one in rehearsed),
    )


def successes(courses: Sequence[Course]) -> int:
    """Of some conditions."""
    return sum(course.success for course in courses)


def needed(rehearsed: Rehearsed) -> int:
    """Under how many conditions the first prediction failed."""
    return sum(course.needed_refinement for course in rehearsed.first)


def holds(answer: Answer, needed_by_thesis: int) -> Holds:
    """Of the claim that few refinements are needed and that every condition is reached in the second round.

    Where one half of it holds and the other does not, it differs.
    """
    conditioned = answer.of_kinds[0]
    few = needed(conditioned) <= needed_by_thesis
    again = successes(conditioned.second) == len(conditioned.second)
    if few and again:
        return Holds.YES
    return Holds.DIFFERS if few or again else Holds.NO


def sentence(answer: Answer, needed_by_thesis: int) -> str:
    """What came out, in words."""
    conditioned, adaptive = answer.of_kinds
    total = len(answer.question.refined)
    first = (
        f"Without exaggeration the thesis' method needed refinements under {needed(conditioned)} of {total} conditions"
        f" (in the thesis {needed_by_thesis}), the default model under {needed(adaptive)}."
    )
    missed = [len(one.second) - successes(one.second) for one in answer.of_kinds]
    if not any(missed):
        return f"{first} In the second round both reached every condition."
    return (
        f"{first} In the second round the thesis' method failed under {missed[0]} of {len(conditioned.second)}, the"
        f" default model under {missed[1]}."
    )


def rows(answer: Answer, needed_by_thesis: int) -> tuple[Row, ...]:
    """What the report's table says."""
    question = answer.question

    def row(quantity: str, thesis: float | None, values: Sequence[float]) -> Row:
        return Row(quantity, "", thesis, *values)

    kinds = answer.of_kinds
    return (
        row(
            f"conditions that needed a refinement, of {len(question.refined)}",
            needed_by_thesis,
            [needed(one) for one in kinds],
        ),
        row("updates of the model in all", None, [sum(course.updates for course in one.first) for one in kinds]),
        row("attempts at refining in all", None, [sum(course.refinements for course in one.first) for one in kinds]),
        row(
            f"conditions reached in the second round, of {len(question.executed)}",
            len(question.executed),
            [successes(one.second) for one in kinds],
        ),
    )


def notes(answer: Answer) -> tuple[str, ...]:
    """Which predictions failed and by what, for each model; and the operator's own failures."""
    said = []
    for kind, rehearsed in zip(CONTENDERS, answer.of_kinds, strict=True):
        first = [f"{number}: {_history(course)}" for number, course in enumerate(rehearsed.first, 1)]
        second = [
            f"{number}: {course.attempts[0].failure}"
            for number, course in enumerate(rehearsed.second, 1)
            if course.attempts and not course.success
        ]
        failed = f" In the second round failed {'; '.join(second)}." if second else ""
        said.append(f"{kind.label[0].upper()}{kind.label[1:]}, condition by condition: {'; '.join(first)}.{failed}")
    return tuple(said)


def _history(course: Course) -> str:
    if not course.needed_refinement:
        return "reached"
    steps = [
        f"{'refinement' if a.mode is messages.Mode.REFINE else 'prediction'} {a.failure}"
        for a in course.attempts
        if a.failure
    ]
    outcome = (
        f"reached after {course.updates} update{'s' if course.updates != 1 else ''}" if course.success else "given up"
    )
    return f"{', then '.join(steps)}; {outcome}"


def _pose(pose: messages.Pose) -> Pose:
    return Pose(np.array(pose.position), np.array(pose.orientation))
