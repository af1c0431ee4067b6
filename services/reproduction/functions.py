"""Appendix A's families of functions, taught as motions.

y(x), x from 0 to 1, becomes the x axis of a motion of one second; more outputs become y and z. One unit is one metre.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lfd.models.model import MovementModel
from lfd.motion.demonstration import Demonstration
from lfd.motion.trajectory import Trajectory

Array = NDArray[np.float64]

POINTS = 100
TAUGHT = (1.0, 2.0, 3.0, 4.0, 5.0)
"""The thesis' values of b."""

X: Array = np.linspace(0.0, 1.0, POINTS)
X.flags.writeable = False


@dataclass(frozen=True)
class Family:
    """Functions y(x; b), and the condition that stands for b.

    Attributes:
        name: as a formula.
        value: of x (n,) and b, shape (n,) for one output, (n, 3) for three.
        condition: s of b, shape (c,).
    """

    name: str
    value: Callable[[Array, float], Array]
    condition: Callable[[float], Array] = lambda b: np.array([b])

    def outputs(self, b: float) -> Array:
        """The function's values, shape (POINTS, outputs)."""
        return self.value(X, b).reshape(POINTS, -1)

    def motion(self, b: float) -> Demonstration:
        """The function as a motion."""
        outputs = self.outputs(b)
        positions = np.zeros((POINTS, 3))
        positions[:, : outputs.shape[1]] = outputs
        orientations = np.tile([1.0, 0.0, 0.0, 0.0], (POINTS, 1))
        return Demonstration(Trajectory(positions, orientations, duration=1.0), np.zeros(3), self.condition(b))

    def motions(self, values: Sequence[float] = TAUGHT) -> list[Demonstration]:
        """The functions of several b."""
        return [self.motion(b) for b in values]

    def predicted(self, model: MovementModel, b: float) -> Array:
        """What a model of the family gives for b, shape (POINTS, outputs)."""
        trajectory = model.predict(self.motion(b).situation, POINTS).trajectory
        return trajectory.positions[:, : self.outputs(b).shape[1]]

    def error(self, model: MovementModel, b: float) -> float:
        """Root mean square of a prediction's deviation from the function."""
        return rms(self.predicted(model, b) - self.outputs(b))


def rms(values: Array) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(values**2)))
