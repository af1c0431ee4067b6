"""The joints' command: inverse kinematics of the reference, within every limit of the joints and clear of the robot.

Where a limit of the joints' motion binds, the arm is behind its reference for a moment, and the reference is to go on
more slowly: as a whole, so that the arm stays on its way instead of leaving it joint by joint.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from services.robot import safety
from services.robot.backends.backend import CONTROL_PERIOD, NativeLimits
from services.robot.easing import eased
from services.robot.execution import angle_between
from services.robot.limiter import Dynamics, Limiter
from services.robot.mechanism import InverseFailed, Mechanism
from services.robot.pace import SLEW
from services.robot.reach import shortfall
from sim.pose import Pose

Array = NDArray[np.float64]

BEHIND, BEHIND_TURN = 0.005, 0.05
"""[m, rad] by which an arm that its joints' motion keeps behind may be behind: its reference all but waits then."""

TOLD = 0.2
"""Share of that from which it is worth saying."""

SLOWEST = 0.1
"""Share of its pace at which a reference goes on at least: nothing that slows it down keeps it from its end."""

LEFT_BEHIND = 0.005
"""[m] between command and arm from which something is in its way: where it holds, the command goes back to the arm."""

SOLVED = 0.9
"""Share of their speed at which the joints are wanted at most, so that one that is behind can catch up."""

_SLEW = SLEW * CONTROL_PERIOD

_SATURATED = 0.999 * SOLVED


def combined(kinematics: Mechanism, native: NativeLimits, velocity_scale: float) -> Dynamics:
    """What joints may do by what is known of the robot, and by what moves it.

    Args:
        kinematics: of the robot.
        native: see `Backend.limits`.
        velocity_scale: share of the speeds that may be used.
    """
    return Dynamics(
        np.maximum(kinematics.lower, native.lower),
        np.minimum(kinematics.upper, native.upper),
        velocity_scale * np.minimum(kinematics.velocity_limit, native.speed),
        np.minimum(kinematics.acceleration_limit, native.acceleration),
        np.minimum(kinematics.jerk_limit, native.jerk),
    )


class Joints:
    """Of one arm; they stand at first.

    Args:
        names: of the joints.
        kinematics: of the arm.
        dynamics: what they may do.
        q: where the joints are, shape (m,).
        velocity_scale: share of the joints' speed limits that may be used.
        self_distance_stop: distance between the robot's parts at which it stops [m].

    Attributes:
        inert: they need more than a period to gain their speed.
        self_distance: between the robot's parts, where they are nearest [m].
        fault: why the arm may not go on; empty where it may.
        share: of its pace at which the reference is to go on.
    """

    def __init__(
        self,
        names: tuple[str, ...],
        kinematics: Mechanism,
        dynamics: Dynamics,
        q: Array,
        *,
        velocity_scale: float,
        self_distance_stop: float,
    ) -> None:
        self._kinematics = kinematics
        self._limits = safety.JointLimits(names, dynamics.lower, dynamics.upper, dynamics.speed)
        self._limiter = Limiter(dynamics, CONTROL_PERIOD, q)
        self._names = names
        self.inert = bool(np.any(dynamics.acceleration * CONTROL_PERIOD < dynamics.speed))
        # The limits allow a shorter step in a shorter period: the solver then keeps to the scaled speeds.
        self._solver_period = SOLVED * velocity_scale * CONTROL_PERIOD
        self._self_distance_stop = self_distance_stop
        self.stand(q)

    @property
    def q(self) -> Array:
        """The command, shape (m,)."""
        return self._limiter.q

    def stand(self, q: Array) -> None:
        """Start afresh, at rest.

        Args:
            q: where the joints are, shape (m,).
        """
        self._limiter.stand(q)
        self._wanted = q
        self.self_distance = self._kinematics.self_distance(q)
        self.fault = ""
        self.share = 1.0

    def hold(self, q: Array, *, begins: bool) -> None:
        """Come to rest, one period of it, as fast as the limits allow.

        Args:
            q: where the joints are measured to be, shape (m,).
            begins: the arm was on its way before. A blocked arm's command lies ahead of it: it must not creep there.
        """
        if begins and self._distance(self.q, q) > LEFT_BEHIND:
            self.stand(q)
        self._limiter.brake()
        self._wanted = self.q
        self.share = 1.0

    def rest(self) -> None:
        """Nothing leads: come to where the last motion led, one period of it."""
        self._limiter.follow(self._wanted)

    def resume(self, q: Array) -> None:
        """Go on after a hold, from where the joints are measured to be, shape (m,), once they stand."""
        if self._limiter.standing:
            self.stand(q)

    def follow(self, target: Pose) -> tuple[str, ...]:
        """Go on by one period, towards a pose of the grasping frame; what was clamped."""
        try:
            solved, _ = self._kinematics.solve_step(
                self._wanted, target.position, target.orientation, self._solver_period
            )
        except InverseFailed as error:
            return self._without(str(error))
        if not np.isfinite(solved).all():
            return self._without("inverse kinematics gave no number")
        before, stood = self._wanted, self.q
        self._wanted, beyond = self._limits.clamp(before, solved, CONTROL_PERIOD)
        behind = self._limiter.follow(self._wanted)
        distance = self._kinematics.self_distance(self.q)
        if safety.self_collision(distance, self.self_distance, self._self_distance_stop):
            self.stand(stood)
            self.fault = f"the robot comes within {distance * 1e3:.0f} mm of itself"
            return beyond
        self.self_distance = distance
        return (*beyond, *self._judged(target, self._wanted - before, behind))

    def _without(self, reason: str) -> tuple[str, ...]:
        """A period in which nothing is known to go to."""
        self._limiter.brake()
        self._wanted = self.q
        return (reason,)

    def _judged(self, target: Pose, step: Array, behind: NDArray[np.bool_]) -> tuple[str, ...]:
        """How far the arm is from its reference, and why; with it how fast the reference may go on."""
        pose = self._kinematics.forward(self.q)
        best = self._kinematics.forward(self._wanted) if behind.any() else pose
        fast = np.abs(step) >= _SATURATED * CONTROL_PERIOD * self._limits.speed
        clamped = []
        if _far(pose, best) > TOLD:
            clamped.append(
                f"acceleration {self._names[int(np.argmax(np.abs(self._limiter.lag) / self._limits.speed))]}"
            )
        gap = _far(pose, target, self._kinematics.turn_slack) if fast.any() else _far(pose, best)
        wanted = max(SLOWEST, 1.0 - eased(min(1.0, gap)))
        # A reference that stopped at once would ask for more than one that goes on.
        self.share += min(max(wanted - self.share, -_SLEW), _SLEW)
        if fast.any() and gap > TOLD:
            clamped.extend(f"speed {self._names[i]}" for i in np.flatnonzero(fast))
        return (*clamped, *shortfall(best, target, self._kinematics.turn_slack))

    def _distance(self, q: Array, other: Array) -> float:
        """Between the grasping frames of two postures [m]."""
        here, there = self._kinematics.forward(q), self._kinematics.forward(other)
        return float(np.linalg.norm(here.position - there.position))


def _far(one: Pose, other: Pose, turn_slack: float = 0.0) -> float:
    """How far two poses are from each other, as shares of `BEHIND` and `BEHIND_TURN`, the larger of them."""
    apart = float(np.linalg.norm(one.position - other.position)) / BEHIND
    return max(apart, angle_between(one.orientation, other.orientation) / (BEHIND_TURN + turn_slack))
