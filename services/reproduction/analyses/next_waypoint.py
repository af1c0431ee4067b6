"""Adapting the next or the current way-point (Appendix B), on the simulated arm."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from lfd.motion.resampling import resample
from lfd.motion.trajectory import PREDICTION_POINTS, Trajectory
from services.offline.rollout import RolloutView, rollout
from services.reproduction.analysis import Analysis, Claim, Context, Figure, Finding, Relation, Row, Source
from services.reproduction.functions import rms
from services.reproduction.models import THESIS
from services.reproduction.operator import AGILITY, Operator
from services.reproduction.scripted import demonstrate
from services.reproduction.style import CONDITIONED, DEMONSTRATION, TRUE_LINE, Line, drawn, panels
from services.robot.arm import Arm
from services.robot.assembly import simulated_arm
from services.robot.backends.backend import CONTROL_PERIOD
from services.robot.correction import UNCORRECTED, Correction
from services.robot.execution import look_ahead
from sim.person.attention import REACTION
from sim.person.intention import Intention, plan
from sim.robots.description import prepare
from sim.tasks import DISHWASHER, TABLE
from sim.tasks.reaching import ReachingScene

Array = NDArray[np.float64]
Displacement = Callable[[RolloutView], Array]

_DURATION = 20.0  # [s] of the thesis' refinements
_STEP = np.array([0.0, 0.0, 0.06])  # [m] upwards
_STEP_AT = 0.3  # share of the prediction
_MEASURED_UNTIL = 0.8
_SETTLED = 0.05  # of the step
_PERSISTENCE = 1.5  # [1/s] of the operator who goes by sight alone
_PRACTISED = 1.0  # [1/s] of the one who knows the way
_ARM_DELAY = 0.05  # [s] of the simulated arm behind its reference, in round figures
_OBJECT = np.array([0.86, 0.07, DISHWASHER.training_positions[0][2]])

NEXT, CURRENT = "next way-point", "current way-point"
_LINES = {NEXT: Line(CONDITIONED, 2.0), CURRENT: Line("#6b4c9a", 1.6)}


@dataclass(frozen=True, eq=False)
class Course:
    """How an episode went, at every control period of the prediction.

    Attributes:
        progress: of the prediction, shape (n,).
        wanted: displacement that was to be reached, shape (n, 3) [m].
        offset: of the measured gripper from the prediction, shape (n, 3) [m].
    """

    progress: Array
    wanted: Array
    offset: Array

    @property
    def times(self) -> Array:
        """Of the prediction, shape (n,) [s]."""
        return self.progress * _DURATION


@dataclass(frozen=True)
class StepResponse:
    """Of a course whose wanted displacement is a step.

    Attributes:
        overshoot: beyond the step, along it [m].
        sideways: largest departure across it [m].
        settling: until the error stays within `_SETTLED` of the step [s].
    """

    overshoot: float
    sideways: float
    settling: float


@dataclass(frozen=True, eq=False)
class _Task:
    """A prediction that an arm executes while an operator corrects it."""

    arm: Arm
    prediction: Trajectory
    object_position: Array

    @classmethod
    def build(cls, scene: ReachingScene, variant: str, object_position: Array) -> Self:
        """The motion that the scene's first variant teaches, in any variant."""
        motion = demonstrate(scene, object_position, None).trajectory
        prediction = replace(resample(motion, PREDICTION_POINTS), duration=_DURATION)
        return cls(simulated_arm(scene, variant, prepare()), prediction, object_position)

    def course(self, ahead: float, wanted: Callable[[float], Array], operator: Displacement) -> Course:
        """Execute it once, with the look-ahead [s], the displacement wanted at each progress, and the operator."""
        progress, wants, offsets = [], [], []

        def attended(view: RolloutView) -> Correction:
            progress.append(view.progress)
            wants.append(wanted(view.progress))
            offsets.append(view.tick.measured.position - view.nominal.position)
            return replace(UNCORRECTED, offset=operator(view))

        rollout(self.arm, self.prediction, self.object_position, operator=attended, after=ahead)
        return Course(np.array(progress), np.array(wants), np.array(offsets))


def step_response(course: Course) -> StepResponse:
    """What a course says about its step."""
    after = (course.progress >= _STEP_AT) & (course.progress < _MEASURED_UNTIL)
    size = float(np.linalg.norm(_STEP))
    along = course.offset[after] @ _STEP / size
    across = course.offset[after] - np.outer(along, _STEP / size)
    off = np.flatnonzero(np.abs(along - size) > _SETTLED * size)
    return StepResponse(
        overshoot=max(float(along.max()) - size, 0.0),
        sideways=float(np.linalg.norm(across, axis=1).max()),
        settling=CONTROL_PERIOD * (float(off[-1]) + 1.0) if off.size else 0.0,
    )


def overshoot(persistence: float, look_ahead_s: float, duration: float = 20.0) -> float:
    """Overshoot of a unit step that an operator corrects by sight, on an arm without delay, as a share of the step.

    Args:
        persistence: of the operator [1/s].
        look_ahead_s: L; 0 moves the current way-point [s].
        duration: that is looked at [s].
    """
    operator, offset, highest = Operator(persistence, CONTROL_PERIOD), np.zeros(3), 0.0
    gain = -math.expm1(-CONTROL_PERIOD / look_ahead_s) if look_ahead_s > 0.0 else 1.0
    unit = np.array([1.0, 0.0, 0.0])
    for _ in range(round(duration / CONTROL_PERIOD)):
        offset = offset + gain * (operator.move(np.zeros(3), unit - offset) - offset)
        highest = max(highest, float(offset[0]))
    return max(highest - 1.0, 0.0)


def _next_waypoint(context: Context) -> Finding:
    table = _Task.build(TABLE, TABLE.variants[0], TABLE.training_positions[-1])
    dishwasher = _Task.build(DISHWASHER, DISHWASHER.variants[1], _OBJECT)
    correction = _correction(dishwasher.prediction)
    ahead = {NEXT: look_ahead(table.prediction), CURRENT: 0.0}
    abrupt, seen, known = dict[str, Course](), dict[str, Course](), dict[str, Course]()
    for which in context.track(list(ahead)):
        abrupt[which] = table.course(ahead[which], _step, _abruptly())
        seen[which] = table.course(ahead[which], _step, _by_sight())
        lead = 2.0 / AGILITY + ahead[which] + _ARM_DELAY
        known[which] = dishwasher.course(ahead[which], correction.displacement, _practised(correction, lead))
    steps = {which: step_response(course) for which, course in abrupt.items()}
    loops = {which: step_response(course) for which, course in seen.items()}
    return Finding(
        _claims(steps, loops),
        tuple(row for which in ahead for row in _rows(which, steps[which], loops[which], known[which])),
        context.drawn(lambda: (_courses_figure(abrupt, seen, known), _overshoot_figure(ahead[NEXT]))),
        (
            f"A prediction of {PREDICTION_POINTS} way-points over {_DURATION:g} s is executed by the simulated arm, and"
            f" measured at the gripper. So L = {ahead[NEXT]:.2f} s; the thesis writes 0.133 s, which belongs to 10 s."
            " It moves from way-point to way-point; here the same rule is applied at the control rate, where L is the"
            " time constant with which the correction follows the stylus.",
            f"By sight: an operator with a reaction time of {REACTION:g} s and a second-order hand at {AGILITY:g}"
            f" rad/s, who pushes away what is missing at {_PERSISTENCE:g} per second. Practised: the same hand, which"
            " knows the correction into the dishwasher and acts ahead by as much as the loop takes. No model takes"
            " part.",
        ),
    )


def _claims(steps: Mapping[str, StepResponse], loops: Mapping[str, StepResponse]) -> tuple[Claim, ...]:
    def less(sentence: str, quantity: str, next_: float, current: float) -> Claim:
        against, unit = "current way-point", "mm"
        return Claim(
            Source.THESIS, sentence, quantity, 1e3 * next_, Relation.BELOW, 1e3 * current, against=against, unit=unit
        )

    return (
        less(
            "Adapting the position of future time steps results in less overshoot: of an abrupt displacement.",
            "overshoot",
            steps[NEXT].overshoot,
            steps[CURRENT].overshoot,
        ),
        less(
            "It results in less overshoot: of what an operator corrects by sight.",
            "overshoot",
            loops[NEXT].overshoot,
            loops[CURRENT].overshoot,
        ),
        less(
            "It is thus more stable: an abrupt displacement throws the arm less far off its way sideways.",
            "departure sideways",
            steps[NEXT].sideways,
            steps[CURRENT].sideways,
        ),
    )


def _rows(which: str, step: StepResponse, loop: StepResponse, known: Course) -> list[Row]:
    said = "“less”" if which == NEXT else "“more”"
    moving = (known.progress > 0.0) & (known.progress < 1.0)
    off = np.linalg.norm(known.offset[moving] - known.wanted[moving], axis=1)

    def row(quantity: str, value: float, unit: str, thesis: str | None = None) -> Row:
        return Row(quantity, {THESIS.name: value}, unit, thesis, headline=thesis is not None)

    return [
        row(f"{which}: overshoot of an abrupt displacement of 60 mm", 1e3 * step.overshoot, "mm", said),
        row("… departure sideways meanwhile", 1e3 * step.sideways, "mm"),
        row("… settling time to 5 %", step.settling, "s"),
        row(f"{which}: overshoot of 60 mm corrected by sight", 1e3 * loop.overshoot, "mm", said),
        row("… settling time to 5 %", loop.settling, "s"),
        row("… practised correction into the dishwasher, RMS error", 1e3 * rms(off), "mm"),
    ]


def _correction(prediction: Trajectory) -> Intention:
    ways = [DISHWASHER.corridor(variant, _OBJECT) for variant in DISHWASHER.variants]
    return plan(prediction.positions, prediction.orientations, ways[1], ways)


def _step(progress: float) -> Array:
    return _STEP if progress >= _STEP_AT else np.zeros(3)


def _abruptly() -> Displacement:
    return lambda view: _step(view.progress)


def _by_sight() -> Displacement:
    operator = Operator(_PERSISTENCE, CONTROL_PERIOD)

    def move(view: RolloutView) -> Array:
        error = _step(view.progress) + view.nominal.position - view.tick.measured.position
        # Before the step there is nothing to correct but the arm's own lag, which nobody minds.
        return operator.move(np.zeros(3), error if view.progress >= _STEP_AT else np.zeros(3))

    return move


def _practised(correction: Intention, lead: float) -> Displacement:
    operator = Operator(_PRACTISED, CONTROL_PERIOD)

    def move(view: RolloutView) -> Array:
        error = correction.pose(view.progress).position - view.tick.measured.position
        known = correction.displacement(view.progress + lead / _DURATION)
        return operator.move(known, error if view.progress > 0.0 else np.zeros(3))

    return move


def _courses_figure(abrupt: dict[str, Course], seen: dict[str, Course], known: dict[str, Course]) -> Figure:
    titles = ["abrupt: upwards, as wanted", "abrupt: sideways", "corrected by sight", "practised, dishwasher: error"]
    canvas, panes = panels(titles, rows=2, height=2.3)
    rows: tuple[tuple[dict[str, Course], Callable[[Course], Array], tuple[float, float]], ...] = (
        (abrupt, lambda c: c.offset[:, 2], (5.5, 9.0)),
        (abrupt, lambda c: np.linalg.norm(c.offset[:, :2], axis=1), (5.5, 9.0)),
        (seen, lambda c: c.offset[:, 2], (4.0, 16.0)),
        (known, lambda c: np.linalg.norm(c.offset - c.wanted, axis=1), (0.0, _DURATION)),
    )
    for axes, (courses, shown, limits) in zip(panes, rows, strict=True):
        for which, course in courses.items():
            axes.plot(course.times, 1e3 * shown(course), **_LINES[which](which))
        axes.set(xlabel="time of the prediction [s]", ylabel="off the prediction [mm]", xlim=limits)
    for axes, courses in ((panes[0], abrupt), (panes[2], seen)):
        course = courses[NEXT]
        axes.plot(course.times, 1e3 * course.wanted[:, 2], **TRUE_LINE("wanted"))
    panes[3].set_ylabel("off what is wanted [mm]")
    return drawn(canvas, "courses", "Where the measured gripper is, under three operators.")


def _overshoot_figure(ahead: float) -> Figure:
    gains = np.linspace(0.25, 2.5, 19)
    canvas, (axes,) = panels([""], height=2.4)
    for which, length in ((NEXT, ahead), (CURRENT, 0.0)):
        axes.plot(gains, [100.0 * overshoot(float(k), length) for k in gains], **_LINES[which](which))
    axes.axvline(_PERSISTENCE, color=DEMONSTRATION, lw=1.0, ls=":", label="operator of the table")
    axes.set(xlabel="how fast a seen error is pushed away [1/s]", ylabel="overshoot [%]")
    return drawn(canvas, "overshoot", "Overshoot of a step corrected by sight, on an arm without a delay of its own.")


NEXT_WAYPOINT = Analysis(
    name="next-waypoint",
    reference="Fig. B.18-B.19, eq. B.7",
    about="Should the operator move the next way-point, or the current one?",
    claim="It was empirically confirmed that adapting the position of future time steps results in less overshoot and"
    " thus more stable behaviour.",
    run=_next_waypoint,
    seconds=8.0,
    person=False,
)
