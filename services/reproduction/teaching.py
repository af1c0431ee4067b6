"""All models through the same conditions: taught by Algorithm 1, then executed once more without teaching."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from lfd.motion.demonstration import Demonstration
from protocol import messages
from services.bus.arrays import quaternion, vector3
from services.offline.demonstrations import demonstrate
from services.offline.pool import overall
from services.offline.rehearsal import Plan, Rehearsed, rehearse
from services.offline.result import Arrangement, Course
from services.reproduction.analysis import Claim, Context, Relation, Row, Source, Value
from services.reproduction.models import CONTENDERS, DEFAULT, FINE, FITS, SHOWN, THESIS, Contender
from services.robot.assembly import simulated_arm
from sim.pose import Pose
from sim.robots.description import prepare
from sim.tasks import AnyScene

Array = NDArray[np.float64]


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
    """What came out.

    Attributes:
        question: that was asked.
        demonstrations: that all models started from.
        rounds: by name of the model; the second round has the conditions beyond at its end.
    """

    question: Question
    demonstrations: tuple[Demonstration, ...]
    rounds: Mapping[str, Rehearsed]

    def first(self, contender: Contender) -> tuple[Course, ...]:
        """Algorithm 1 under each condition."""
        return self.rounds[contender.name].first

    def second(self, contender: Contender) -> tuple[Course, ...]:
        """The second round."""
        return self.rounds[contender.name].second[: len(self.question.executed)]

    def beyond(self, contender: Contender) -> tuple[Course, ...]:
        """The conditions that the model was to generalise to."""
        return self.rounds[contender.name].second[len(self.question.executed) :]

    def values(self, of: Callable[[Contender], Value]) -> dict[str, Value]:
        """A value of each model, by its name."""
        return {contender.name: of(contender) for contender in CONTENDERS}


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
    """Let one person teach every model."""
    demonstrations = taught(question.scene, question.demonstrated, context.rng())
    executed = (*question.executed, *question.beyond)
    tell = overall(len(CONTENDERS), context.advance)
    rounds = {}
    for number, contender in enumerate(CONTENDERS):
        plan = Plan(
            question.scene.name,
            contender.name,
            demonstrations,
            question.refined,
            executed,
            seed=context.seed,
            models=FITS,
        )
        rounds[contender.name] = rehearse(plan, partial(tell, number))
    return Answer(question, demonstrations, rounds)


def successes(courses: Sequence[Course]) -> int:
    """Of some conditions."""
    return sum(course.success for course in courses)


def needed(courses: Sequence[Course]) -> int:
    """Under how many conditions the first prediction failed."""
    return sum(course.needed_refinement for course in courses)


def claims(answer: Answer, thesis: Sequence[Claim]) -> tuple[Claim, ...]:
    """The thesis' claims, and those of Retouch about the same conditions.

    Args:
        answer: what came out.
        thesis: its claims.
    """
    total, ours = len(answer.question.executed), needed(answer.first(DEFAULT))
    return (
        *thesis,
        Claim(
            Source.RETOUCH,
            "For the default model one refinement is enough for all conditions.",
            "conditions refined",
            ours,
            Relation.AT_MOST,
            1,
        ),
        Claim(
            Source.RETOUCH,
            "The default model needs fewer refinements than the thesis' model does with the same start anchor and the"
            " same resolution.",
            "conditions refined",
            ours,
            Relation.BELOW,
            needed(answer.first(FINE)),
            against=FINE.label,
        ),
        Claim(
            Source.RETOUCH,
            "In the second round the default model succeeds under every condition.",
            "conditions reached",
            successes(answer.second(DEFAULT)),
            Relation.AT_LEAST,
            total,
        ),
    )


def few_needed(answer: Answer, sentence: str, most: int) -> Claim:
    """The thesis' claim that few conditions had to be refined."""
    value = needed(answer.first(THESIS))
    return Claim(Source.THESIS, sentence, "conditions refined", value, Relation.AT_MOST, most)


def reached_again(answer: Answer, sentence: str) -> Claim:
    """The thesis' claim that the second round succeeds under every condition."""
    second = answer.second(THESIS)
    return Claim(Source.THESIS, sentence, "conditions reached", successes(second), Relation.AT_LEAST, len(second))


def rows(answer: Answer, needed_by_thesis: int) -> tuple[Row, ...]:
    """What the report's table says."""
    refined, executed = len(answer.question.refined), len(answer.question.executed)
    return (
        Row(
            "conditions that needed a refinement",
            answer.values(lambda one: needed(answer.first(one))),
            thesis=needed_by_thesis,
            total=refined,
            headline=True,
        ),
        Row(
            "updates of the model in all",
            answer.values(lambda one: sum(course.updates for course in answer.first(one))),
        ),
        Row(
            "attempts at refining in all",
            answer.values(lambda one: sum(course.refinements for course in answer.first(one))),
        ),
        Row(
            "conditions reached in the second round",
            answer.values(lambda one: successes(answer.second(one))),
            thesis=executed,
            total=executed,
            headline=True,
        ),
        Row(
            "every condition reached in the second round",
            answer.values(lambda one: successes(answer.second(one)) == executed),
            thesis=True,
        ),
    )


def notes(answer: Answer) -> tuple[str, ...]:
    """Which predictions failed and by what, for the thesis' model and the default; and the operator's own failures."""
    said = []
    for kind in SHOWN:
        first = [f"{number}: {_history(course)}" for number, course in enumerate(answer.first(kind), 1)]
        second = [
            f"{number}: {course.attempts[0].failure}"
            for number, course in enumerate(answer.second(kind), 1)
            if course.attempts and not course.success
        ]
        failed = f" In the second round failed {'; '.join(second)}." if second else ""
        said.append(f"The first person with the {kind.label}, condition by condition: {'; '.join(first)}.{failed}")
    return tuple(said)


def _history(course: Course) -> str:
    if not course.needed_refinement:
        return "reached"
    steps = [
        f"{'refinement' if a.mode is messages.Mode.REFINE else 'prediction'} {a.failure}"
        for a in course.attempts
        if a.failure
    ]
    ending = (
        f"reached after {course.updates} update{'s' if course.updates != 1 else ''}" if course.success else "given up"
    )
    return f"{', then '.join(steps)}; {ending}"


def _pose(pose: messages.Pose) -> Pose:
    return Pose(np.array(pose.position), np.array(pose.orientation))
