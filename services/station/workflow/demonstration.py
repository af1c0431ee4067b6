"""A motion that was led by hand, as the model learns it."""

from __future__ import annotations

import numpy as np

from lfd.exceptions import LfdError
from lfd.motion.resampling import along_the_way, resample
from lfd.motion.trajectory import Trajectory
from protocol.messages import Motion
from services.bus.arrays import motion_from_wire, motion_to_wire
from services.process.exceptions import ServiceError
from services.station.workflow.settings import Settings

LEAST_WAY = 0.05
"""A hand that led the gripper less far showed nothing [m]."""


def demonstrated(led: Motion, settings: Settings) -> Motion | None:
    """The motion with as many points as are learnt, evenly along its way unless the tempo is to be kept.

    Args:
        led: by the hand, at equal times.
        settings: of the run.

    Returns:
        The motion; None where it leads nowhere.
    """
    try:
        motion = Trajectory(*motion_from_wire(led))
    except (LfdError, ServiceError):
        return None  # of numbers that no robot sends
    if np.sum(np.linalg.norm(np.diff(motion.positions, axis=0), axis=1)) < LEAST_WAY:
        return None
    learnt = (resample if settings.keeps_tempo else along_the_way)(motion, settings.points)
    return motion_to_wire(learnt.positions, learnt.orientations, learnt.duration, learnt.opening)
