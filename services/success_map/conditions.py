"""Where a model succeeds: conditions all over a scene, what became of each, and what that comes to."""

from __future__ import annotations

import math
from enum import Enum

import msgspec
import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from protocol.messages import Vector3
from services.bus.arrays import vector3
from sim.pose import Pose
from sim.tasks.scene import ReachingScene

Array = NDArray[np.float64]


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
        object_position: of the object's centre, base frame [m].
        offset: of the start from the scene's own, base axes [m].
    """

    object_position: Vector3
    offset: Vector3 = (0.0, 0.0, 0.0)

    def start(self, scene: ReachingScene) -> Pose:
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


UNREACHABLE = Trial(Ending.UNREACHABLE)


class Condition(msgspec.Struct, frozen=True):
    """A place, and what became of the prediction there at each stage of the model."""

    place: Setting
    trials: tuple[Trial, ...]


class SuccessMap(msgspec.Struct, frozen=True):
    """Where a model succeeds, at one or two stages of it.

    Attributes:
        scene: by name.
        variant: of the scene.
        kind: of the model.
        corrections: that the model had learnt at each stage, growing.
        conditions: that were tried.
    """

    scene: str
    variant: str
    kind: str
    corrections: tuple[int, ...]
    conditions: tuple[Condition, ...]

    def count(self, stage: int, outcome: Ending) -> int:
        """Conditions with an outcome at a stage."""
        return sum(condition.trials[stage].outcome is outcome for condition in self.conditions)

    @property
    def reachable(self) -> int:
        """Conditions at which a motion can succeed."""
        return len(self.conditions) - self.count(-1, Ending.UNREACHABLE)

    def summary(self) -> str:
        """What came out, in a line."""
        reachable = self.reachable
        reached = [self.count(stage, Ending.REACHED) for stage in range(len(self.corrections))]
        said = f"{reached[-1]} of {reachable} reachable conditions succeed ({_percent(reached[-1], reachable)})"
        if len(reached) == 1:
            return f"{stage_name(self.corrections[0])}: {said}"
        before = f"{reached[0]} ({_percent(reached[0], reachable)})"
        return f"{stage_name(self.corrections[-1])}: {said}; {stage_name(self.corrections[0], before=True)}: {before}"


def stage_name(corrections: int, *, before: bool = False) -> str:
    """What a model's stage is called.

    Args:
        corrections: that it has learnt.
        before: it is the earlier one of two.
    """
    if corrections == 0:
        return "before" if before else "without correction"
    return f"after {corrections} correction{'' if corrections == 1 else 's'}"


def grid(scene: ReachingScene, n: int, spread: float) -> tuple[Setting, ...]:
    """About n * n object positions evenly all over a scene's region, each with a start of its own.

    The cells are as square as the region allows. The starts fill their cube evenly (a Halton sequence), so that each
    neighbourhood of objects has starts from all sides.

    Args:
        scene: where.
        n: at least 1.
        spread: of a start from the scene's own along each axis, at most [m].
    """
    lower, upper = np.array(scene.region.lower), np.array(scene.region.upper)
    depth, width, _ = upper - lower
    across = max(1, round(n * math.sqrt(width / depth)))
    along = max(1, round(n * n / across))
    x, y = np.meshgrid(_middles(along), _middles(across), indexing="ij")
    shares = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, 0.5)])
    starts = qmc.Halton(3, scramble=False).random(x.size + 1)[1:]  # its first point is a corner
    return _places(lower + shares * (upper - lower), spread * (2.0 * starts - 1.0))


def sample(scene: ReachingScene, n: int, spread: float, rng: np.random.Generator) -> tuple[Setting, ...]:
    """Random object positions and starts, both even.

    Args:
        scene: where.
        n: how many.
        spread: of a start from the scene's own along each axis, at most [m].
        rng: of the draws.
    """
    objects = np.array([scene.region.sample(rng) for _ in range(n)])
    return _places(objects, rng.uniform(-spread, spread, (n, 3)))


def _middles(n: int) -> Array:
    """The middles of n equal parts of the numbers from 0 to 1."""
    return (np.arange(n) + 0.5) / n


def _places(objects: Array, offsets: Array) -> tuple[Setting, ...]:
    return tuple(Setting(vector3(one), vector3(offset)) for one, offset in zip(objects, offsets, strict=True))


def _percent(part: int, whole: int) -> str:
    return f"{100.0 * part / whole:.1f} %" if whole else "none is reachable"
