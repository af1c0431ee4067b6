"""Where a model succeeds: conditions all over a scene, what became of each, and what that comes to."""

from __future__ import annotations

import math
from enum import Enum

import msgspec
import numpy as np
from numpy.typing import NDArray

from protocol.messages import Vector3
from services.bus.arrays import vector3
from services.offline.proportion import Proportion
from sim.pose import Pose
from sim.tasks import AnyScene

Array = NDArray[np.float64]
Target = tuple[float, ...]


class Ending(Enum):
    """What became of a prediction; the first that holds of those that fail."""

    REACHED = "reached"
    COLLISION = "collision"
    KICKED_OVER = "kicked over"
    NOT_REACHED = "not reached"
    UNREACHABLE = "unreachable"


class Setting(msgspec.Struct, frozen=True):
    """A condition of a map.

    Attributes:
        target: place of the target: centre of the object, or y of the via-points, shape (d,) [m].
        offset: of the start from the scene's own, base axes [m].
    """

    target: Target
    offset: Vector3 = (0.0, 0.0, 0.0)

    def start(self, scene: AnyScene) -> Pose:
        """Of the motion; the orientation is the scene's."""
        return Pose(scene.start.position + np.array(self.offset), scene.start.orientation)


class Trial(msgspec.Struct, frozen=True):
    """One prediction, executed.

    Attributes:
        outcome: of it.
        touched: the robot's part and the thing that met, where they did.
    """

    outcome: Ending
    touched: tuple[str, str] | None = None


_CANDIDATES = 8  # about the square root of how many places a correction is sought among

UNREACHABLE = Trial(Ending.UNREACHABLE)


class Condition(msgspec.Struct, frozen=True):
    """A setting, and what became of the prediction there at each stage of the model."""

    setting: Setting
    trials: tuple[Trial, ...]


class SuccessMap(msgspec.Struct, frozen=True):
    """Where a model succeeds, at one or two stages of it.

    Attributes:
        scene: by name.
        variant: of the scene.
        kind: of the model.
        corrections: that the model had learnt at each stage, growing; the most that anybody gave.
        conditions: that were tried.
        corrected: places of the corrections, in the order in which they were given; the first person's.
        people: who corrected, one after another; their models took turns at the conditions.
    """

    scene: str
    variant: str
    kind: str
    corrections: tuple[int, ...]
    conditions: tuple[Condition, ...]
    corrected: tuple[Target, ...] = ()
    people: int = 1

    def count(self, stage: int, outcome: Ending) -> int:
        """Conditions with an outcome at a stage."""
        return sum(condition.trials[stage].outcome is outcome for condition in self.conditions)

    @property
    def reachable(self) -> int:
        """Conditions at which a motion can succeed."""
        return len(self.conditions) - self.count(-1, Ending.UNREACHABLE)

    @property
    def worse(self) -> int:
        """Conditions that succeeded at the earlier stage and do not at the later one."""
        ends = [(one.trials[0].outcome, one.trials[-1].outcome) for one in self.conditions]
        return sum(before is Ending.REACHED and after is not Ending.REACHED for before, after in ends)

    def summary(self) -> str:
        """What came out, in a line."""
        reachable = self.reachable
        reached = [self.count(stage, Ending.REACHED) for stage in range(len(self.corrections))]
        said = f"{reached[-1]} of {reachable} reachable conditions succeed ({Proportion(reached[-1], reachable)})"
        if len(reached) == 1:
            return f"{stage_name(self.corrections[0])}: {said}"
        before = f"{reached[0]} ({Proportion(reached[0], reachable)})"
        worse = f", of which {self.worse} fail now" if self.worse else ""
        after = stage_name(self.corrections[-1]) + (f" by each of {self.people} people" if self.people > 1 else "")
        return f"{after}: {said}; {stage_name(self.corrections[0], before=True)}: {before}{worse}"


def stage_name(corrections: int, *, before: bool = False) -> str:
    """What a model's stage is called.

    Args:
        corrections: that it has learnt.
        before: it is the earlier one of two.
    """
    if corrections == 0:
        return "before" if before else "without correction"
    return f"after {corrections} correction{'' if corrections == 1 else 's'}"


def grid(scene: AnyScene, n: int, spread: float) -> tuple[Setting, ...]:
    """About n * n targets evenly all over a scene's region, each with a start of its own.

    The cells are as square as the region allows. The starts fill their cube evenly (a Halton sequence), so that each
    neighbourhood of targets has starts from all sides; where a person cannot move the robot they do not move either.

    Args:
        scene: where.
        n: at least 1.
        spread: of a start from the scene's own along each axis, at most [m].
    """
    from scipy.stats import qmc  # noqa: PLC0415 - takes long to import, and a wrong flag is told before

    lower, upper = np.array(scene.region.lower), np.array(scene.region.upper)
    depth, width = (upper - lower)[:2]
    across = max(1, round(n * math.sqrt(width / depth)))
    along = max(1, round(n * n / across))
    x, y = np.meshgrid(_middles(along), _middles(across), indexing="ij")
    shares = np.full((x.size, len(lower)), 0.5)
    shares[:, 0], shares[:, 1] = x.ravel(), y.ravel()
    starts = qmc.Halton(3, scramble=False).random(x.size + 1)[1:]  # its first point is a corner
    return _settings(lower + shares * (upper - lower), spread * np.array(scene.freedom.axes) * (2.0 * starts - 1.0))


def in_turn(scene: AnyScene, n: int) -> list[Target]:
    """Places to correct at, one after another: the training positions, then always the one that is furthest from all.

    Args:
        scene: where.
        n: how many.
    """
    chosen = [np.array(place) for place in scene.training_positions[:n]]
    candidates = np.array([setting.target for setting in grid(scene, _CANDIDATES, 0.0)])
    while len(chosen) < n:
        apart = np.linalg.norm(candidates[:, None] - np.array(chosen), axis=2).min(axis=1)
        chosen.append(candidates[np.argmax(apart)])
    return [tuple(place.tolist()) for place in chosen]


def sample(scene: AnyScene, n: int, spread: float, rng: np.random.Generator) -> tuple[Setting, ...]:
    """Random targets and starts, both even.

    Args:
        scene: where.
        n: how many.
        spread: of a start from the scene's own along each axis, at most [m].
        rng: of the draws.
    """
    targets = np.array([scene.region.sample(rng) for _ in range(n)])
    return _settings(targets, np.array(scene.freedom.axes) * rng.uniform(-spread, spread, (n, 3)))


def _middles(n: int) -> Array:
    """The middles of n equal parts of the numbers from 0 to 1."""
    return (np.arange(n) + 0.5) / n


def _settings(targets: Array, offsets: Array) -> tuple[Setting, ...]:
    pairs = zip(targets.tolist(), offsets, strict=True)
    return tuple(Setting(tuple(target), vector3(offset)) for target, offset in pairs)
