"""The joints' command within their limits of speed, acceleration and jerk, one control period after another.

Speed, acceleration and jerk are those of the command itself, by differences over the period h:

    v = (q - q_before) / h,    a = (v - v_before) / h,    j = (a - a_before) / h.

What can be followed exactly is followed exactly. What cannot is caught up with: each joint goes towards the wanted
position, at the wanted speed and beyond it by as much as it can lose again on the way that is left; all joints by the
same share of theirs, so that the arm comes back straight. From speed to speed acceleration rises and falls by the
jerk: a, a - J h, a - 2 J h and so on add up to the change of speed (the least time in which it can be had).

A step counts only where the joint can still stop before the end of its range afterwards. Braking is such a step: where
it could before, it can again.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ROUNDING = 1e-9
"""Share of a limit by which rounding may exceed it."""

_CATCHING_UP_A, _CATCHING_UP_J = 0.5, 0.25
"""Shares of acceleration and jerk with which the way that is left is to be braked on: the rest is for getting there."""

_NEAREST = 0.3
"""Of what is left to catch up at most in a period: the last of it comes without a swing."""


@dataclass(frozen=True, eq=False)
class Dynamics:
    """What joints may do between the ends of their ranges.

    Attributes:
        lower: least positions, shape (m,) [rad, m].
        upper: greatest positions, shape (m,).
        speed: greatest speeds, shape (m,) [rad/s].
        acceleration: greatest accelerations, shape (m,) [rad/s^2].
        jerk: greatest jerks, shape (m,) [rad/s^3].
    """

    lower: Array
    upper: Array
    speed: Array
    acceleration: Array
    jerk: Array


def braking_speed(way: Array, acceleration: Array, jerk: Array) -> Array:
    """The speed from which a joint comes to rest on a way, within an acceleration and a jerk, each of shape (m,).

    From rest and back s = v sqrt(v / J) up to v = A^2 / J, and s = v (v / A + A / J) / 2 above.
    """
    soft = np.cbrt(jerk * way**2)
    corner = acceleration**2 / jerk
    hard = np.sqrt(0.25 * corner**2 + 2.0 * acceleration * way) - 0.5 * corner
    return np.where(soft <= corner, soft, hard)


class Limiter:
    """Follows wanted joint positions. It begins at rest.

    Args:
        dynamics: of the joints.
        period: of the control [s].
        q: positions where it begins, shape (m,).
    """

    def __init__(self, dynamics: Dynamics, period: float, q: Array) -> None:
        self._dynamics = dynamics
        self._period = period
        self._step = dynamics.jerk * period  # of the acceleration
        self._braking = _CATCHING_UP_A * dynamics.acceleration, _CATCHING_UP_J * dynamics.jerk
        self.stand(q)

    @property
    def lag(self) -> Array:
        """By how much the joints are behind what was wanted of them, shape (m,)."""
        return self._wanted - self.q

    @property
    def standing(self) -> bool:
        """The joints are at rest."""
        return not (self._v.any() or self._a.any())

    def stand(self, q: Array) -> None:
        """Begin afresh, at rest.

        Args:
            q: positions, shape (m,).
        """
        self.q: Array = q.copy()
        self._wanted = self.q
        self._carried: Array = np.zeros_like(self.q)
        self._v: Array = np.zeros_like(self.q)
        self._a: Array = np.zeros_like(self.q)

    def follow(self, wanted: Array) -> NDArray[np.bool_]:
        """Go on by one period.

        Args:
            wanted: positions at its end, shape (m,).

        Returns:
            The joints that could not follow, shape (m,).
        """
        h, behind = self._period, self.lag
        carried = (wanted - self._wanted) / h
        risen = (carried - self._carried) / h
        self._wanted, self._carried = wanted, carried
        speed = (wanted - self.q) / h
        acceleration = (speed - self._v) / h
        if self._stays(risen, acceleration, behind).all() and self._can(speed, acceleration).all():
            self._go(wanted, speed, acceleration)
            return np.zeros(len(wanted), dtype=bool)
        carried = _within(carried, self._dynamics.speed)
        foreseen = self._foreseen(behind, carried, _within(risen, self._dynamics.acceleration))
        self._aim(_within(carried + self._catching_up(foreseen), self._dynamics.speed))
        return np.abs(self.q - wanted) > ROUNDING

    def brake(self) -> None:
        """Come to rest as fast as the limits allow, one period of it; nothing is wanted but to stand."""
        if not self.standing:
            self._aim(np.zeros_like(self.q))
        self._wanted, self._carried = self.q, self._v

    def _stays(self, risen: Array, acceleration: Array, behind: Array) -> NDArray[np.bool_]:
        """Whether each joint that comes to the wanted position with an acceleration can then stay on its way."""
        most = self._step * (1.0 + ROUNDING)
        beyond = behind / self._period**2
        return (np.abs(beyond) <= most) & (np.abs(risen - beyond - acceleration) <= most)

    def _foreseen(self, behind: Array, carried: Array, risen: Array) -> Array:
        """By how much the joints will be behind once they no longer gain or lose speed on what is wanted."""
        v, a = self._v - carried, self._a - risen
        takes = np.abs(a) / self._dynamics.jerk
        return behind - takes * (v + takes * a / 3.0)

    def _can(self, speed: Array, acceleration: Array) -> NDArray[np.bool_]:
        """Whether each joint can have that speed and acceleration in this period, and stop afterwards."""
        may, h = self._dynamics, self._period
        slack = 1.0 + ROUNDING
        ends = speed + h * _faded(acceleration, self._step)
        can = (
            (np.abs(acceleration - self._a) <= self._step * slack)
            & (np.abs(acceleration) <= may.acceleration * slack)
            & (np.abs(speed) <= may.speed * slack)
            & (np.abs(ends) <= may.speed * slack)
        )
        for i in np.flatnonzero(can & ~self._far(speed, acceleration)):
            can[i] = self._stops(int(i), float(speed[i]), float(acceleration[i]))
        return can

    def _far(self, speed: Array, acceleration: Array) -> NDArray[np.bool_]:
        """Whether the end of the range is so far that there is no need to look whether the joint stops before it."""
        may, h = self._dynamics, self._period
        fastest = np.abs(speed) + np.abs(acceleration) * (h + np.abs(acceleration) / may.jerk)
        longest = 2.0 * h + 2.0 * np.sqrt(fastest / may.jerk) + fastest / may.acceleration + may.acceleration / may.jerk
        way = fastest * longest
        return (self.q - way > may.lower) & (self.q + way < may.upper)

    def _stops(self, i: int, v: float, a: float) -> bool:
        """Whether a joint that has this speed and acceleration at the end of the period stops within its range."""
        may, h, step = self._dynamics, self._period, float(self._step[i])
        lower, upper, most = float(may.lower[i]), float(may.upper[i]), float(may.acceleration[i])
        slack = ROUNDING * (upper - lower)
        q = float(self.q[i]) + h * v
        while lower - slack <= q <= upper + slack:
            if abs(v) <= ROUNDING * step * h and abs(a) <= ROUNDING * step:
                return True
            a = _towards(a, -v / h, step, most)
            v += h * a
            q += h * v
        return False

    def _catching_up(self, behind: Array) -> Array:
        """Speeds beyond the wanted ones, shape (m,): the same share of the way that is left for every joint."""
        way = np.maximum(np.abs(behind), ROUNDING)
        return behind * min(_NEAREST / self._period, float((braking_speed(way, *self._braking) / way).min()))

    def _aim(self, speed: Array) -> None:
        """Towards a speed within the limits, in the least time; where that does not let a joint stop it brakes."""
        may, h = self._dynamics, self._period
        acceleration = _towards_all(self._a, (speed - self._v) / h, self._step, may.acceleration)
        brakes = ~self._can(self._v + h * acceleration, acceleration)
        if brakes.any():
            braking = _towards_all(self._a, -self._v / h, self._step, may.acceleration)
            acceleration = np.where(brakes, braking, acceleration)
        v = self._v + h * acceleration
        self._go(np.clip(self.q + h * v, may.lower, may.upper), v, acceleration)

    def _go(self, q: Array, v: Array, a: Array) -> None:
        self.q, self._v, self._a = q, v, a


def _faded(a: Array, step: Array) -> Array:
    """What a - J h, a - 2 J h and so on to nothing add up to, with the sign of a."""
    size = np.abs(a)
    whole = np.floor(size / step)
    return np.copysign(whole * (size - 0.5 * step * (whole + 1.0)), a)


def _towards_all(a: Array, change: Array, step: Array, most: Array) -> Array:
    """The next accelerations with which a change of speed, in acceleration periods, is had soonest."""
    share = np.abs(change) / step
    whole = np.floor(0.5 * (np.sqrt(1.0 + 8.0 * share) - 1.0))
    first = np.copysign(step * (share / (whole + 1.0) + 0.5 * whole), change)
    return _within(np.minimum(np.maximum(first, a - step), a + step), most)


def _within(vector: Array, most: Array) -> Array:
    return np.minimum(np.maximum(vector, -most), most)  # in half the time of np.clip


def _towards(a: float, change: float, step: float, most: float) -> float:
    """See `_towards_all`, of one joint."""
    share = abs(change) / step
    whole = math.floor(0.5 * (math.sqrt(1.0 + 8.0 * share) - 1.0))
    first = math.copysign(step * (share / (whole + 1.0) + 0.5 * whole), change)
    return max(-most, min(most, max(a - step, min(a + step, first))))
