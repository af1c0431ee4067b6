"""What stands in for camera and perception, whose pictures would take most of a rehearsal's time."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from protocol.messages import ObjectPose, Pose
from protocol.topics import OBJECT_POSE, WORLD_STATE
from services.bus.arrays import vector3
from services.bus.bus import Bus
from sim.tasks.thing import Tag

Array = NDArray[np.float64]

MEDIAN_ERROR = 0.0014  # [m] of a sighting
DEVIATION = MEDIAN_ERROR / 1.5382  # [m] on each axis: the length of a normal vector in space has that median over it
PICTURES = 9  # that a sighting rests on, the default window of the perception's filter
_PUT = 0.02  # [m] an object that is found further away than this from where it was has been put there anew


class Eyes:
    """Publishes the object's true pose with the error that the perception was measured to have.

    The head camera draws the same picture of the same still scene again and again, so the error of a sighting stays
    as it is until the object is put elsewhere: drawing it anew for every picture would let the filter average it away.
    Its median length is 1.4 mm, as in whole runs; over 40 places of each scene, pictures of 320 by 240 pixels and the
    perception's filter gave medians of 0.9 mm in the dishwasher and 0.5 mm on the table, and 1.8 mm for nine in ten.
    Unlike the camera it also sees the object behind the arm; nothing that is rehearsed looks at it then.

    Args:
        bus: to the robot's other processes.
        rng: of the error.
    """

    rate_hz = OBJECT_POSE.rate_hz

    def __init__(self, bus: Bus, rng: np.random.Generator) -> None:
        self._bus = bus
        self._rng = rng
        self._world = bus.subscribe(WORLD_STATE)
        self._place: Array = np.full(3, math.inf)
        self._error: Array = np.zeros(3)

    def step(self, now_ns: int) -> None:
        """Publish the newest pose."""
        world = self._world.fresh(now_ns)
        if world is None:
            return
        place = np.array(world.object_pose.position)
        if np.linalg.norm(place - self._place) > _PUT:
            self._error = DEVIATION * self._rng.standard_normal(3)
        self._place = place
        seen = ObjectPose(
            pose=Pose(vector3(place + self._error), world.object_pose.orientation),
            tag=Tag().id,
            error=float(np.linalg.norm(self._error)),
            pictures=PICTURES,
        )
        self._bus.publish(OBJECT_POSE, seen)
