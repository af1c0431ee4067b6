"""Motions that an operator showed, made into what the robot can execute like a prediction."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lfd.motion.resampling import resample
from lfd.motion.trajectory import PREDICTION_POINTS, Trajectory
from lfd.motion.waypoints import LEAST_WAYPOINTS, Passing, passed_at, through_waypoints
from protocol.messages import Origin, Waypoint
from protocol.queries import Plan
from services.bus.arrays import motion_from_wire
from services.model.skill import check_duration, check_opening
from services.process.exceptions import ServiceError
from sim.tasks import AnyScene

ALREADY_THERE = 0.01
"""A first waypoint so near to the start is the start [m]."""

_DENSEST = 500
"""Points of a plan at most; a denser motion is thinned out."""


class NothingPlanned(ServiceError):
    """What was given makes no motion."""


class Planned(NamedTuple):
    """A plan.

    Attributes:
        motion: to execute, in the base frame.
        waypoints: phases at which the operator's waypoints are passed; empty where there are none.
    """

    motion: Trajectory
    waypoints: tuple[float, ...] = ()


def planned(scene: AnyScene, request: Plan) -> Planned:
    """The motion that a request describes.

    Args:
        scene: that it is for.
        request: what the operator showed.

    Raises:
        NothingPlanned: it is no motion.
        LfdError: its numbers make none.
        NotFinite: they are none.
        OutOfReach: a waypoint, or the motion between, is beyond the robot's reach; says which waypoint.
        OutOfRange: it is too fast or too slow for a robot.
        OpeningUnfit: it does not say how far the gripper is open where that takes part, or says it where it does not.
    """
    given = _through(scene, request) if request.origin is Origin.WAYPOINTS else Planned(_shown(request))
    check_duration("the motion's duration", given.motion)
    check_opening(scene, given.motion)
    scene.robot.check("the motion passes", given.motion.positions)
    scene.robot.check("the target at", np.array(request.object_position)[None])
    return given


def _through(scene: AnyScene, request: Plan) -> Planned:
    positions, orientations = _poses(request.waypoints)
    if request.motion is not None:
        raise NothingPlanned("a plan through waypoints takes no motion: give the one or the other")
    if len(positions) < LEAST_WAYPOINTS:
        raise NothingPlanned(f"{len(positions)} waypoint(s) make no motion: store at least {LEAST_WAYPOINTS}")
    for number, position in enumerate(positions, 1):
        scene.robot.check(f"waypoint {number} at", position[None])
    waypoints, led = request.waypoints, 0
    if request.start is not None and math.dist(request.start.position, waypoints[0].position) > ALREADY_THERE:
        waypoints, led = (request.start, *waypoints), 1
        positions, orientations = _poses(waypoints)
    opening, duration = _openings(waypoints), request.duration
    motion = through_waypoints(
        positions, orientations, duration, PREDICTION_POINTS, Passing.CENTRIPETAL, opening=opening
    )
    passed = passed_at(positions, orientations, Passing.CENTRIPETAL, opening=opening, duration=duration)
    return Planned(motion, tuple(passed[led:].tolist()))


def _openings(waypoints: tuple[Waypoint, ...]) -> list[float] | None:
    """Of the gripper from each waypoint on [m]; None where it takes no part."""
    openings = [waypoint.opening for waypoint in waypoints if waypoint.opening is not None]
    if openings and len(openings) < len(waypoints):
        raise NothingPlanned(
            "some waypoints have an opening of the gripper and some have none: give it to all, or to none"
        )
    return openings or None


def _shown(request: Plan) -> Trajectory:
    if request.motion is None or request.waypoints or request.origin is Origin.MODEL:
        raise NothingPlanned(f"a plan of origin {request.origin.value} takes a motion, and no waypoints")
    motion = replace(Trajectory(*motion_from_wire(request.motion)), duration=request.duration)
    return resample(motion, _DENSEST) if motion.n_points > _DENSEST else motion


def _poses(poses: tuple[Waypoint, ...]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    positions = np.array([pose.position for pose in poses], dtype=np.float64).reshape(-1, 3)
    orientations = np.array([pose.orientation for pose in poses], dtype=np.float64).reshape(-1, 4)
    return positions, orientations / np.linalg.norm(orientations, axis=1, keepdims=True)
