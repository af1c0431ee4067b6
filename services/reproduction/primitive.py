"""The thesis' comparator as a model like the others: the DMP of the motion shown nearest by, led to the object."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from lfd.models.adaptive.adaptation import AdaptiveOptions
from lfd.models.anchor import Anchor
from lfd.models.distribution import MotionDistribution
from lfd.models.dmp import DMP
from lfd.models.encoding import Encoding
from lfd.models.model import Prediction, completed, in_part
from lfd.motion.demonstration import Demonstration, Situation, check_demonstrations, check_dimension
from lfd.motion.trajectory import PREDICTION_POINTS, Trajectory


@dataclass(frozen=True, eq=False)
class NearestPrimitive:
    """A primitive for each motion; the one whose condition is nearest, the newest of several, predicts.

    It begins at the start pose, and its goal is the end of its own motion, as far from the object as it was there: what
    an object detection can tell it (appendix B). It is as sure as a single motion can make it, which is wholly.

    Attributes:
        shown: demonstrations and corrections, the newest last.
        primitives: of each.
    """

    shown: tuple[Demonstration, ...]
    primitives: tuple[DMP, ...]

    @classmethod
    def fit(cls, demonstrations: Sequence[Demonstration]) -> Self:
        """See `MovementModel.fit`."""
        check_demonstrations(demonstrations)
        return cls(tuple(demonstrations), tuple(DMP.fit(one.trajectory) for one in demonstrations))

    def updated(self, demonstration: Demonstration) -> Self:
        """See `MovementModel.updated`."""
        self._check(demonstration.situation)
        whole = in_part(self, completed(self, demonstration))
        return type(self)((*self.shown, whole), (*self.primitives, DMP.fit(whole.trajectory)))

    def predict(self, situation: Situation, n: int = PREDICTION_POINTS) -> Prediction:
        """See `MovementModel.predict`."""
        return Prediction(self._led(situation, n), np.zeros((n, 3, 3)), duration_std=0.0)

    def distribution(self, situation: Situation) -> MotionDistribution:
        """See `MovementModel.distribution`: one motion, drawn by the default model's basis functions."""
        options = AdaptiveOptions()
        trajectory = self._led(situation, options.samples)
        encoding = Encoding(options.basis, options.samples, trajectory.orientations[-1], Anchor.straight())
        mean = encoding.encode(Demonstration(trajectory, situation.origin, situation.condition))
        return MotionDistribution(encoding, situation, mean, np.zeros((len(mean), len(mean))))

    def _led(self, situation: Situation, n: int) -> Trajectory:
        self._check(situation)
        newest_first = range(len(self.shown) - 1, -1, -1)
        nearest = min(
            newest_first, key=lambda i: float(np.linalg.norm(self.shown[i].condition - situation.condition).round(9))
        )
        shown = self.shown[nearest]
        own = shown.trajectory
        goal = own.positions[-1] - shown.origin + situation.origin
        start = (situation.start_position, situation.start_orientation)
        return self.primitives[nearest].reproduce(start, (goal, own.orientations[-1]), own.duration, n)

    def _check(self, situation: Situation) -> None:
        check_dimension(situation.condition, len(self.shown[0].condition))
