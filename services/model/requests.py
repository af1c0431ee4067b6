"""What requests say, in the library's own words."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lfd.motion.demonstration import Demonstration, Situation
from lfd.motion.provenance import Method, Provenance
from lfd.motion.trajectory import Trajectory
from protocol.queries import AddDemonstration, Predict
from services.bus.arrays import motion_from_wire


def demonstration_in(request: AddDemonstration, at_s: float) -> Demonstration:
    """The demonstration that a request brings, given at a time in seconds since 1970-01-01 UTC."""
    motion = Trajectory(*motion_from_wire(request.motion))
    origin = np.array(request.object_position, dtype=np.float64)
    provenance = Provenance(request.operator, at_s, request.alpha, Method(request.method.value))
    part = request.part.first, request.part.last
    if request.condition:
        return Demonstration(motion, origin, np.array(request.condition), provenance, part)
    return replace(Demonstration.reaching(motion, origin, provenance), part=part)


def situation_in(request: Predict) -> Situation:
    """Where a motion is asked for."""
    origin, start = np.array(request.object_position), request.start
    position, orientation = np.array(start.position), np.array(start.orientation)
    if not request.condition:
        return Situation.reaching(origin, position, orientation)
    return Situation(np.array(request.condition), origin, position, orientation)
