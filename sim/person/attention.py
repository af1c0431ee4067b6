"""What a person notices of a robot that they watch: late, and not quite where it is."""

from collections import deque
from dataclasses import dataclass

from sim.person.sight import Sight
from sim.pose import Pose

REACTION = 0.2  # [s] from seeing to acting on it: 0.19 to 0.26 s (Keele and Posner 1968)
GLANCE = 0.2  # [s] over which it is seen how fast something moves


@dataclass(frozen=True, eq=False)
class Glimpse:
    """The robot as it seemed at one moment.

    Attributes:
        time: Of the look [s].
        progress: Of the motion, from 0 to 1.
        robot: Where the grasping frame seemed to be.
    """

    time: float
    progress: float
    robot: Pose


class Attention:
    """One person's eyes for one motion, and what of it has reached them.

    Args:
        sight: Of the place.
        reaction: From seeing to acting on it [s].
    """

    def __init__(self, sight: Sight, reaction: float = REACTION) -> None:
        self._sight = sight
        self._reaction = reaction
        self._seen: deque[Glimpse] = deque()

    def look(self, time: float, progress: float, robot: Pose) -> Glimpse:
        """Look; what is noticed now, which was seen a reaction time ago.

        Args:
            time: Of any clock that does not go back [s].
            progress: Of the motion, from 0 to 1.
            robot: Pose of the grasping frame.
        """
        dt = time - self._seen[-1].time if self._seen else 0.0
        seems = Pose(self._sight.look(robot.position, dt), robot.orientation)
        self._seen.append(Glimpse(time, progress, seems))
        while len(self._seen) > 1 and self._seen[1].time <= time - self._reaction - GLANCE:
            self._seen.popleft()
        return self.noticed

    @property
    def noticed(self) -> Glimpse:
        """The newest that is a reaction time old; the oldest where none is."""
        old = [glimpse for glimpse in self._seen if glimpse.time <= self._seen[-1].time - self._reaction]
        return old[-1] if old else self._seen[0]

    @property
    def pace(self) -> float:
        """How fast the motion seems to go on [1/s]."""
        before, noticed = self._seen[0], self.noticed
        return (noticed.progress - before.progress) / (noticed.time - before.time) if noticed is not before else 0.0
