"""What a robot is to whoever teaches it: its kind, and where its grasping frame can be at all."""

from dataclasses import dataclass

import numpy as np

from sim.exceptions import OutOfReach
from sim.region import Array, Region


@dataclass(frozen=True)
class Robot:
    """A kind of robot; what was learnt with one is good for that kind only.

    Attributes:
        kind: Its name, "tiago" for one.
        reach: Box around all positions that its grasping frame can take, base frame [m]. Not all in it can be taken.
    """

    kind: str
    reach: Region

    def check(self, what: str, positions: Array) -> None:
        """Let pass positions that the robot may be able to take.

        Args:
            what: They are called in an error.
            positions: Shape (n, 3), base frame [m].

        Raises:
            OutOfReach: One of them lies outside the box.
        """
        low, high = np.array(self.reach.lower), np.array(self.reach.upper)
        outside = np.flatnonzero(~np.all((positions >= low) & (positions <= high), axis=1))
        if outside.size:
            where = f"the reach of {self.kind}"
            raise OutOfReach(what, positions[outside[0]].tolist(), where, self.reach.lower, self.reach.upper)


TIAGO = Robot("tiago", Region((-0.5, -1.05, -0.2), (1.15, 1.05, 1.95)))
"""PAL Robotics' TIAGo, torso and arm: 60 000 random postures lie in the box, a tenth of a metre from its sides."""

PARTICLE = Robot("particle", Region((-0.1, -0.5, -0.1), (0.6, 0.5, 0.1)))
"""The point of the thesis' two-dimensional example, and room around its board."""
