"""Whether the arm can follow what an operator showed, found out before it moves: inverse kinematics along the way.

The search starts from where the arm stands and goes along the motion as the arm would; where an arm could come there
by another way, it would have to be led by that way. And how far from a reference a command stays, while it moves.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from lfd.motion.resampling import at_phases
from lfd.motion.trajectory import Trajectory
from services.robot.execution import angle_between
from services.robot.mechanism import InverseFailed, Mechanism
from services.robot.refusal import Refusal
from sim.pose import Pose

Array = NDArray[np.float64]

SHORT = 0.04  # [m] by which the arm may stay away from the motion: it does by 24 mm on ways that succeed
TURNED = 0.5  # [rad] the same of its orientation, which gives way first: by 0.25 there
LOOKS = 40  # places of the motion that are tried, the waypoints beside
OUT_OF_REACH = 0.005  # [m] between reference and command from which it is reported
OUT_OF_TURN = 0.05  # [rad] the same of their orientations, which give way first at the joints' limits
_STEP_S = 0.5  # long enough that the joints' speeds do not bind: pace is another limit's
_STEPS = 4
_NEAR = 2e-3  # [m] within which a place counts as found


def check_reach(kinematics: Mechanism, q: Array, motion: Trajectory, waypoints: Sequence[float]) -> None:
    """Let a motion pass that the arm can follow.

    Args:
        kinematics: of the arm.
        q: joint positions that it starts from, shape (m,).
        motion: in the base frame.
        waypoints: phases at which the operator's waypoints are passed.

    Raises:
        Refusal: it cannot; says at or between which waypoints, and what to do.
    """
    phases = np.union1d(np.linspace(0.0, 1.0, LOOKS), waypoints)
    places = at_phases(motion, phases)
    for phase, position, orientation in zip(phases.tolist(), places.positions, places.orientations, strict=True):
        q = _followed(kinematics, q, position, orientation)
        stands = kinematics.forward(q)
        short = float(np.linalg.norm(stands.position - position))
        turned = angle_between(stands.orientation, orientation)
        if short > SHORT or turned > TURNED + kinematics.turn_slack:
            how = (
                f"stays {short * 1e3:.0f} mm away" if short > SHORT else f"turns {np.degrees(turned):.0f} degrees less"
            )
            raise Refusal(f"{_where(phase, waypoints)}: the arm {how} there; {_remedy(phase, waypoints)}", lasting=True)


def shortfall(commanded: Pose, reference: Pose, turn_slack: float) -> list[str]:
    """By how much the joints do not bring the grasping frame to the reference, where that is worth saying."""
    gap = float(np.linalg.norm(commanded.position - reference.position))
    short = [f"reach: {gap * 1e3:.0f} mm short"] if gap > OUT_OF_REACH else []
    if abs(float(commanded.orientation @ reference.orientation)) < math.cos(0.5 * (OUT_OF_TURN + turn_slack)):
        angle = angle_between(commanded.orientation, reference.orientation)
        short.append(f"reach: {math.degrees(angle):.0f} degrees short")
    return short


def _followed(kinematics: Mechanism, q: Array, position: Array, orientation: Array) -> Array:
    """Joint positions as near to a pose as the arm comes from where it is."""
    for _ in range(_STEPS):
        try:
            q, _ = kinematics.solve_step(q, position, orientation, _STEP_S)
        except InverseFailed:
            return q
        stands: Pose = kinematics.forward(q)
        if np.linalg.norm(stands.position - position) < _NEAR:
            return q
    return q


def _where(phase: float, waypoints: Sequence[float]) -> str:
    if phase in waypoints:
        return f"waypoint {list(waypoints).index(phase) + 1} is out of reach"
    behind = sum(passed < phase for passed in waypoints)
    if behind == 0:
        return "the way to waypoint 1 is out of reach"
    return f"the way from waypoint {behind} to waypoint {behind + 1} is out of reach"


def _remedy(phase: float, waypoints: Sequence[float]) -> str:
    if phase in waypoints:
        return "move it nearer to the robot, turn it less, or delete it"
    return "store a waypoint between them that the robot reaches, or change their order"
