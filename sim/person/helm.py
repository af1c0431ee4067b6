"""A person who leads a robot by a device that they push or drag, and sees what comes of it only on the robot."""

from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from sim.person.attention import Attention
from sim.person.intention import Intention
from sim.person.itinerary import Itinerary
from sim.pose import Pose
from sim.rotations import rotation_to

Array = NDArray[np.float64]

Act_co = TypeVar("Act_co", covariant=True)
Act = TypeVar("Act")

FOLLOWS = 0.3  # [s] that a practised person expects a correction to take until the robot has made it
FOLLOWS_LED = 0.1  # [s] the same where nothing but the hand leads it
_STANDS = 1e-6  # [1/s] of progress, below which the robot is seen to stand


class Reach(Protocol[Act_co]):
    """Whatever a person leads with: `Fingers` or a `Pen`."""

    def act(self, time: float, left: Array) -> Act_co:
        """Lead on by what is left, shape (6,) [m, rad]."""
        ...

    def rest(self) -> Act_co:
        """Let go."""
        ...

    def expected(self, value: Array, since: float, *, decays: bool) -> Array:
        """Where what is led should be now, that was at a value some time ago, shape (6,)."""
        ...


class Helm:
    """Eyes and hand for one motion.

    Args:
        attention: Of the person.
        askew: By how much they misjudge the axes of the device, about the vertical [rad].
    """

    def __init__(self, attention: Attention, askew: float = 0.0) -> None:
        self._attention = attention
        cos, sin = np.cos(askew), np.sin(askew)
        turn = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
        self._pushed = np.kron(np.eye(2), turn)  # along the axes and about them alike

    def correct(self, hand: Reach[Act], time: float, progress: float, robot: Pose, intention: Intention) -> Act:
        """Lead a robot off its prediction while it moves.

        Args:
            hand: On the device.
            time: Of any clock that does not go back [s].
            progress: Of the motion, from 0 to 1.
            robot: Pose of the grasping frame.
            intention: What is to become of the prediction.
        """
        noticed, pace = self._attention.look(time, progress, robot), self._attention.pace
        predicted = intention.predicted(noticed.progress)
        seen = _between(predicted, noticed.robot)
        ahead = noticed.progress + (time - noticed.time + FOLLOWS) * pace
        wanted = np.concatenate([intention.displacement(ahead), intention.rotation(ahead)])
        expected = hand.expected(seen, noticed.time - FOLLOWS, decays=True)
        # A robot that stands still is waiting: pushing harder would only make it jump later.
        return hand.act(time, self._pushed @ (wanted - expected) if pace > _STANDS else np.zeros(6))

    def lead(self, hand: Reach[Act], time: float, robot: Pose, itinerary: Itinerary) -> tuple[Act, bool]:
        """Lead a robot that nothing else leads; and whether it stands where it was led to.

        Args:
            hand: On the device.
            time: Of any clock that does not go back [s].
            robot: Pose of the grasping frame.
            itinerary: Where to.
        """
        noticed = self._attention.look(time, 0.0, robot)
        seen = _between(itinerary.aim, noticed.robot)
        left = -hand.expected(seen, noticed.time - FOLLOWS_LED, decays=False)
        return hand.act(time, self._pushed @ left), itinerary.arrived(time, left)


def _between(one: Pose, other: Pose) -> Array:
    """From one pose to the other, in base axes, shape (6,) [m, rad]."""
    return np.concatenate([other.position - one.position, rotation_to(one.orientation, other.orientation)])
