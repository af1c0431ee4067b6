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
from services.robot.limiter import Dynamics, Limiter, braking_speed
from services.robot.mechanism import InverseFailed, Mechanism
from services.robot.pace import SLEW
from services.robot.reach import shortfall
from services.robot.slowing import TOLD as SLOW
from services.robot.slowing import Approach, Zone
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

ITSELF_M, ITSELF_CREEP = 0.025, 0.01
"""[m, m/s] before the distance to itself at which the robot stops, the zone in which it slows down, and its end."""

SINGULAR = Zone(0.0, 0.03, 0.02)
"""Of the dexterity; motions that ship stay above 0.04."""

_SLEW = SLEW * CONTROL_PERIOD

_AT_BOUND = 0.999
_SATURATED = _AT_BOUND * SOLVED
_STANDS = 1e-4  # [rad] of a step: a joint that has come to the end of its range slows nothing down any more


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
        near: the same by what the arm is near to alone, whatever its joints can follow.
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
        self._itself = Zone(self_distance_stop, self_distance_stop + ITSELF_M, ITSELF_CREEP)
        self._braking = dynamics.acceleration, dynamics.jerk
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
        self.share = self.near = 1.0
        self._to_itself = Approach(self._itself, CONTROL_PERIOD, self.self_distance)
        self._to_singular = Approach(SINGULAR, CONTROL_PERIOD, self._kinematics.dexterity(q))

    def end(self, q: Array) -> None:
        """The motion is over. A blocked arm's command lies ahead of it: it must not creep there.

        Args:
            q: where the joints are measured to be, shape (m,).
        """
        if self._distance(self.q, q) > LEFT_BEHIND:
            self.stand(q)

    def hold(self, q: Array, *, begins: bool) -> None:
        """Come to rest, one period of it, as fast as the limits allow.

        Args:
            q: where the joints are measured to be, shape (m,).
            begins: the arm was on its way before; see `end`.
        """
        if begins:
            self.end(q)
        self._limiter.brake()
        self._wanted = self.q
        self.share = self.near = 1.0

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
        slow = self._approached()
        return (*beyond, *self._judged(target, before, behind), *slow)

    def _without(self, reason: str) -> tuple[str, ...]:
        """A period in which nothing is known to go to."""
        self._limiter.brake()
        self._wanted = self.q
        return (reason,)

    def _approached(self) -> tuple[str, ...]:
        """What the arm slows down for, and by how much."""
        itself = self._to_itself.share(self.self_distance, self.near)
        singular = self._to_singular.share(self._kinematics.dexterity(self.q), self.near)
        self.near = _slewed(self.near, max(SLOWEST, min(itself, singular)))
        if self.near > SLOW:
            return ()
        return (
            f"slow: {self.self_distance * 1e3:.0f} mm from itself" if itself < singular else "slow: nearly singular",
        )

    def _judged(self, target: Pose, before: Array, behind: NDArray[np.bool_]) -> tuple[str, ...]:
        """How far the arm is from its reference, and why; with it how fast the reference may go on."""
        pose = self._kinematics.forward(self.q)
        best = self._kinematics.forward(self._wanted) if behind.any() else pose
        fast, braking = self._bound(before)
        bound = fast.any() or braking.any()
        gap = _far(pose, target, self._kinematics.turn_slack) if bound else _far(pose, best)
        self.share = min(self.near, _slewed(self.share, max(SLOWEST, 1.0 - eased(min(1.0, gap)))))
        said = []
        if _far(pose, best) > TOLD:
            last = int(np.argmax(np.abs(self._limiter.lag) / self._limits.speed))
            said.append(f"acceleration {self._names[last]}")
        if bound and gap > TOLD:
            said += [f"speed {self._names[i]}" for i in np.flatnonzero(fast)]
            said += [f"slow: near the limit of {self._names[i]}" for i in np.flatnonzero(braking)]
        return (*said, *shortfall(best, target, self._kinematics.turn_slack))

    def _bound(self, before: Array) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Which joints are wanted as fast as they may be, and which as fast as they can still brake."""
        step, limits = self._wanted - before, self._limits
        fast = np.abs(step) >= _SATURATED * CONTROL_PERIOD * limits.speed
        way = np.where(step > 0.0, limits.upper - before, before - limits.lower)
        fastest = self._solver_period * braking_speed(np.maximum(way, 0.0), *self._braking)
        return fast, (np.abs(step) >= _AT_BOUND * fastest) & (np.abs(step) > _STANDS) & ~fast

    def _distance(self, q: Array, other: Array) -> float:
        """Between the grasping frames of two postures [m]."""
        here, there = self._kinematics.forward(q), self._kinematics.forward(other)
        return float(np.linalg.norm(here.position - there.position))


def _far(one: Pose, other: Pose, turn_slack: float = 0.0) -> float:
    """How far two poses are from each other, as shares of `BEHIND` and `BEHIND_TURN`, the larger of them."""
    apart = float(np.linalg.norm(one.position - other.position)) / BEHIND
    return max(apart, angle_between(one.orientation, other.orientation) / (BEHIND_TURN + turn_slack))


def _slewed(share: float, wanted: float) -> float:
    """The share in the next period: a reference that stopped at once would ask for more than one that goes on."""
    return share + min(max(wanted - share, -_SLEW), _SLEW)
