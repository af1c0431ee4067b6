"""How many updates with one and the same refinement it takes (Appendix B, "Slow adaptation")."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lfd.motion.demonstration import Demonstration
from lfd.motion.trajectory import Trajectory
from protocol.messages import Mode
from services.offline.rehearsal import Plan, rehearse
from services.offline.result import Arrangement
from services.offline.rollout import rollout
from services.offline.steering import DURATION_S
from services.process.exceptions import CommandFailed
from services.reproduction import teaching
from services.reproduction.analysis import Analysis, Claim, Context, Figure, Finding, Relation, Row, Source
from services.reproduction.models import CONTENDERS, DEFAULT, FINE, SHOWN, THESIS, Contender
from services.reproduction.style import DEMONSTRATION_LINE, OBSTACLE, REFINEMENT, Line, drawn, panels
from services.robot.arm import Arm
from services.robot.assembly import simulated_arm
from sim.robots.description import prepare
from sim.tasks import DISHWASHER
from sim.tasks.scene import Group

Array = NDArray[np.float64]

_UPDATES_OF_THESIS = 11
_DEMONSTRATIONS = (2, 6, 12)
_SHOWN = 1  # of them, in the figure
_MOST_UPDATES = 60
_VARIANT = DISHWASHER.variants[1]


@dataclass(frozen=True, eq=False)
class Way:
    """Of a model, fed with one refinement again and again.

    Attributes:
        predictions: the first one, and one after each update; the last one succeeds, unless there are too many.
        succeeded: the last one did.
    """

    predictions: tuple[Trajectory, ...]
    succeeded: bool

    @property
    def updates(self) -> int:
        """That it took."""
        return len(self.predictions) - 1


def _slow_adaptation(context: Context) -> Finding:
    (x0, y0, z), (x1, y1, _) = DISHWASHER.region.lower, DISHWASHER.region.upper
    place = np.array([(x0 + x1) / 2, (y0 + y1) / 2, z])
    demonstrations = _demonstrations(place, y0, y1, context.rng())
    refinement = _refinement(place, demonstrations, context.seed)
    arm = simulated_arm(DISHWASHER, _VARIANT, prepare())
    ways: dict[int, dict[Contender, Way]] = {}
    for count in context.track(_DEMONSTRATIONS):
        some = [demonstrations[i] for i in np.linspace(0, len(demonstrations) - 1, count).round().astype(int)]
        ways[count] = {kind: _fed(kind, some, refinement, arm) for kind in CONTENDERS}
    return Finding(
        _claims(ways),
        tuple(
            Row(
                f"updates until the basket is avoided, after {count} demonstrations",
                {kind.name: way.updates for kind, way in ways[count].items()},
                thesis=f"≈ {_UPDATES_OF_THESIS}" if count == _DEMONSTRATIONS[_SHOWN] else None,
                headline=True,
            )
            for count in _DEMONSTRATIONS
        ),
        context.drawn(
            lambda: (_predictions_figure(ways[_DEMONSTRATIONS[_SHOWN]], refinement), _rest_figure(ways, refinement))
        ),
        (
            "The demonstrations reach objects across the basket in position b1; the object stands in their middle. The"
            " scripted operator refined the thesis' model once in position b2, in natural size, and that refinement is"
            f" fed again and again; every prediction is executed in the simulator. At most {_MOST_UPDATES} updates are"
            " tried. The thesis does not say how many trajectories its initial model was trained with.",
        ),
    )


def _claims(ways: Mapping[int, Mapping[Contender, Way]]) -> tuple[Claim, ...]:
    few, *_, many = _DEMONSTRATIONS
    quantity = f"updates after {many} demonstrations"
    ours = ways[many][DEFAULT].updates
    return (
        Claim(
            Source.THESIS,
            "A model that was trained with more trajectories needs to be updated about 11 times with the same one.",
            quantity,
            ways[many][THESIS].updates,
            Relation.AT_LEAST,
            _UPDATES_OF_THESIS,
        ),
        Claim(
            Source.THESIS,
            "More trajectories in the initial model make it slower.",
            quantity,
            ways[many][THESIS].updates,
            Relation.ABOVE,
            ways[few][THESIS].updates,
            against=f"after {few}",
        ),
        Claim(
            Source.RETOUCH,
            "The default model needs a single update, however many demonstrations it started from.",
            "most updates",
            max(of_kinds[DEFAULT].updates for of_kinds in ways.values()),
            Relation.AT_MOST,
            1,
        ),
        Claim(
            Source.RETOUCH,
            "The thesis' model is as slow with the start anchor and the default model's resolution: it is slow because"
            " it averages.",
            quantity,
            ways[many][FINE].updates,
            Relation.ABOVE,
            ours,
            against=DEFAULT.label,
        ),
    )


def _demonstrations(place: Array, y0: float, y1: float, rng: np.random.Generator) -> tuple[Demonstration, ...]:
    across = np.linspace(y0, y1, _DEMONSTRATIONS[-1]).tolist()
    trained = DISHWASHER.variants[0]
    arrangements = [Arrangement(trained, (float(place[0]), y, float(place[2]))) for y in across]
    return teaching.taught(DISHWASHER, arrangements, rng)


def _refinement(place: Array, demonstrations: tuple[Demonstration, ...], seed: int) -> Demonstration:
    """What the scripted operator makes of the thesis' model's prediction, in an autonomous execution's tempo."""
    x, y, z = place.tolist()
    plan = Plan(
        DISHWASHER.name, "promp", demonstrations, (Arrangement(_VARIANT, (x, y, z)),), seed=seed, updates_allowed=1
    )
    (course,) = rehearse(plan).first
    for attempt in course.attempts:
        if attempt.mode is Mode.REFINE and attempt.success:
            shown = replace(attempt.commanded, orientations=attempt.refined.orientations, duration=DURATION_S)
            return Demonstration.reaching(shown, place)
    raise CommandFailed(f"no refinement of {course.refinements} succeeded")


def _fed(kind: Contender, demonstrations: Sequence[Demonstration], refinement: Demonstration, arm: Arm) -> Way:
    model = kind.fit(demonstrations)
    situation = demonstrations[0].situation
    asked = type(situation).reaching(refinement.origin, situation.start_position, situation.start_orientation)
    predictions = []
    while True:
        predictions.append(replace(model.predict(asked).trajectory, duration=DURATION_S))
        outcome = rollout(arm, predictions[-1], refinement.origin, variant=_VARIANT, to_collision=True)
        if outcome.verdict.success or len(predictions) > _MOST_UPDATES:
            return Way(tuple(predictions), outcome.verdict.success)
        model = model.updated(refinement)


def _predictions_figure(ways: Mapping[Contender, Way], refinement: Demonstration) -> Figure:
    from matplotlib.patches import Rectangle  # noqa: PLC0415 - see `style`

    canvas, panes = panels([kind.label for kind in SHOWN], height=3.0)
    for axes, kind in zip(panes, SHOWN, strict=True):
        way = ways[kind]
        for box in DISHWASHER.boxes(_VARIANT):
            if box.group is Group.PANEL:
                (x, _, z), (half_x, _, half_z) = box.centre, box.half_sizes
                corner, size = (x - half_x, z - half_z), (2.0 * half_x, 2.0 * half_z)
                axes.add_patch(Rectangle(corner, *size, color=OBSTACLE, alpha=0.25, lw=0.0))
        for number, prediction in enumerate(way.predictions):
            last = number == way.updates
            line = Line(kind.line.color, 1.8) if last else Line(kind.line.color, 0.7)
            label = f"after {way.updates} update{'s' * (way.updates > 1)}" if last else "before"
            p = prediction.positions
            axes.plot(p[:, 0], p[:, 2], **line(f"{kind.label}: {label}"), alpha=1.0 if last else 0.55)
        p = refinement.trajectory.positions
        axes.plot(p[:, 0], p[:, 2], **Line(REFINEMENT, 1.4)("refinement"))
        axes.set(xlabel="x [m]", xlim=(0.38, 0.95), ylim=(0.40, 0.82), aspect="equal")
        axes.sharey(panes[0])
    panes[0].set_ylabel("z [m]")
    count = _DEMONSTRATIONS[_SHOWN]
    return drawn(
        canvas,
        "predictions",
        f"From the side: predictions after {count} demonstrations, and the basket in b2 (Fig. B.23).",
    )


def _rest_figure(ways: Mapping[int, Mapping[Contender, Way]], refinement: Demonstration) -> Figure:
    from matplotlib.ticker import MaxNLocator  # noqa: PLC0415 - see `style`

    canvas, panes = panels([f"after {count} demonstrations" for count in ways], height=2.4)
    for axes, of_kinds in zip(panes, ways.values(), strict=True):
        for kind, way in of_kinds.items():
            rest = [1e3 * _distance(p, refinement.trajectory) for p in way.predictions]
            axes.plot(range(len(rest)), rest, marker="o", ms=3.5, **Line(kind.line.color, 1.2)(kind.label))
        axes.set(xlabel="updates", ylim=(0.0, None))
        axes.xaxis.set_major_locator(MaxNLocator(6, integer=True))
        axes.sharey(panes[0])
        axes.grid(color=DEMONSTRATION_LINE.color, alpha=0.25)
    panes[0].set_ylabel("distance to the refinement [mm]")
    caption = "Greatest distance of a prediction to the refinement, until the basket is avoided."
    return drawn(canvas, "rest", caption)


def _distance(prediction: Trajectory, refinement: Trajectory) -> float:
    """The furthest that a point of the prediction is from the refinement, whenever that is there [m]."""
    apart = np.linalg.norm(prediction.positions[:, None] - refinement.positions[None], axis=2)
    return float(apart.min(axis=1).max())


SLOW_ADAPTATION = Analysis(
    name="slow-adaptation",
    reference="Fig. B.23",
    about="How many updates with the same refinement until the prediction avoids the basket?",
    claim="When an initial model is trained with more trajectories, the model needs to be updated ≈ 11 times with the"
    " same refined trajectory in order to change the prediction to avoid the obstacle.",
    run=_slow_adaptation,
    seconds=50.0,
)
