"""The keys of the operator's page as a master: rate control with a dead man's switch."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np

from lfd.motion.rotations import exp_map, log_map, multiply
from protocol.keys import PUSH_KEYS, STEERING, TURN_KEYS, Direction
from protocol.messages import Figure, OperatorInput, Phase, RobotState, Vector3
from services.bus.arrays import vector3
from services.master.devices.device import ZERO, Moment, Sample
from services.process.config import Keyboard

LET_GO_S = 0.2
"""Within this time displacement and rotation are zero after focus, tab, link or process was lost [s]."""


@dataclass(frozen=True)
class Law:
    """How three numbers answer their keys; their unit u is the metre or the radian.

    Attributes:
        growth: of a number while a key is held [u/s].
        decay: towards zero without [u/s].
        reach: largest [u].
    """

    growth: float
    decay: float
    reach: float


def directions(keys: Collection[str], table: Mapping[str, Direction]) -> tuple[int, int, int]:
    """Which way each axis is pushed by a table's keys: -1, 0 or 1; keys against each other cancel out."""
    axes = [0, 0, 0]
    for key in set(keys) & table.keys():
        axis, sign = table[key]
        axes[axis] += sign
    return (axes[0], axes[1], axes[2])


def pushed(value: float, direction: int, dt: float, law: Law) -> float:
    """One number after dt [s]: grows while a key is held, decays to zero without [u]."""
    if direction == 0:
        return _towards_zero(value, law.decay * dt)
    return max(-law.reach, min(law.reach, value + direction * law.growth * dt))


def _towards_zero(value: float, distance: float) -> float:
    return max(0.0, value - distance) if value > 0.0 else min(0.0, value + distance)


class _Lever:
    """Three numbers and the keys that push them.

    Args:
        table: of the keys.
        law: by which they push.
    """

    def __init__(self, table: Mapping[str, Direction], law: Law) -> None:
        self._table = table
        self._law = law
        self.value = ZERO

    def take_over(self, value: Vector3) -> None:
        """Go on from a value, as far as the reach allows."""
        x, y, z = (max(-self._law.reach, min(self._law.reach, v)) for v in value)
        self.value = (x, y, z)

    def hold(self, keys: Collection[str], dt: float) -> None:
        """Let the held keys push for dt [s]."""
        x, y, z = (
            pushed(v, way, dt, self._law) for v, way in zip(self.value, directions(keys, self._table), strict=True)
        )
        self.value = (x, y, z)

    def rates(self, keys: Collection[str]) -> Vector3:
        """How fast the held keys move the three numbers that lead alone [u/s]."""
        x, y, z = directions(keys, self._table)
        return (x * self._law.growth, y * self._law.growth, z * self._law.growth)

    def let_go(self, dt: float) -> None:
        """Return to zero, within `LET_GO_S` from anywhere."""
        self.take_over(self.value)
        x, y, z = (_towards_zero(v, self._law.reach / LET_GO_S * dt) for v in self.value)
        self.value = (x, y, z)


class KeyboardMaster:
    """Turns held keys into a displacement and a rotation, as fast as the clock goes and not as fast as messages come.

    Where the hand leads the robot without a prediction nothing decays: what the keys have moved stays, as far as it
    goes, and only what changes counts.

    A key counts only while an episode is led or refined and the page's newest state is fresh and focused.
    Otherwise nobody is at the device: it disengages at once and both fall to zero within `LET_GO_S`. Whoever engages
    it takes over the correction as the robot applies it then: a held robot does not jump back because its operator, or
    this process, was away. While the robot does not execute yet, on its way to the start or held, the device follows
    the correction that it applies; a key held meanwhile counts once all keys have been let go.

    Args:
        law: growth, decay and reach of both.
    """

    name = "keyboard"

    def __init__(self, law: Keyboard) -> None:
        self._push = _Lever(PUSH_KEYS, Law(law.growth, law.decay, law.reach))
        self._turn = _Lever(TURN_KEYS, Law(law.turn_growth, law.turn_decay, law.turn_reach))
        self._engaged = False
        self._neutral: bool

    def step(self, moment: Moment) -> Sample:
        """Advance by the time that has passed."""
        if moment.teaching is not None:
            return self._lead(moment.teaching, moment.operator, moment.dt)
        robot, operator = moment.refining, moment.operator
        if robot is None or operator is None or not operator.focused:
            return self._let_go(moment.dt)
        if not self._engaged or robot.phase is not Phase.EXECUTE:
            return self._follow(robot, operator)
        self._neutral = self._neutral or _is_neutral(operator)
        keys = operator.keys if self._neutral else ()
        before = self._push.value
        self._push.hold(keys, moment.dt)
        self._turn.hold(keys, moment.dt)
        return self._sample(before, moment.dt)

    def figures(self) -> tuple[Figure, ...]:
        """A keyboard measures nothing."""
        return ()

    def close(self) -> None:
        """There is no hardware to let go of."""

    def _lead(self, robot: RobotState, operator: OperatorInput | None, dt: float) -> Sample:
        """Move by what the keys say; nobody at them, and keys that were held before they counted, leave it standing."""
        before = self._push.value
        if operator is None or not operator.focused:
            self._engaged = False
        elif not self._engaged or robot.phase is not Phase.EXECUTE:
            self._engaged, self._neutral = True, _is_neutral(operator)
        else:
            self._neutral = self._neutral or _is_neutral(operator)
            keys = operator.keys if self._neutral else ()
            self._push.value = _moved(before, self._push.rates(keys), dt)
            self._turn.value = _turned(self._turn.value, self._turn.rates(keys), dt)
        return self._sample(before, dt)

    def _follow(self, robot: RobotState, operator: OperatorInput) -> Sample:
        """Stand where the correction is that the robot applies, whatever is held."""
        x, y, z = robot.offset
        self._push.take_over((x / robot.master_gain, y / robot.master_gain, z / robot.master_gain))
        self._turn.take_over(robot.turn)
        self._engaged, self._neutral = True, _is_neutral(operator)
        return Sample(self._push.value, ZERO, self._turn.value, engaged=True)

    def _let_go(self, dt: float) -> Sample:
        self._engaged = False
        before = self._push.value
        self._push.let_go(dt)
        self._turn.let_go(dt)
        return self._sample(before, dt)

    def _sample(self, before: Vector3, dt: float) -> Sample:
        velocity = _velocity(before, self._push.value, dt)
        return Sample(self._push.value, velocity, self._turn.value, engaged=self._engaged)


def _is_neutral(operator: OperatorInput) -> bool:
    return STEERING.isdisjoint(operator.keys)


def _moved(value: Vector3, rates: Vector3, dt: float) -> Vector3:
    x, y, z = (v + rate * dt for v, rate in zip(value, rates, strict=True))
    return (x, y, z)


def _turned(rotation: Vector3, rates: Vector3, dt: float) -> Vector3:
    """A rotation, turned on about the base axes: however far, the keys turn about the same ones."""
    step = exp_map(dt * np.array(rates))
    return vector3(log_map(multiply(step, exp_map(np.array(rotation)))))


def _velocity(before: Vector3, after: Vector3, dt: float) -> Vector3:
    if dt <= 0.0:
        return ZERO
    return (after[0] - before[0]) / dt, (after[1] - before[1]) / dt, (after[2] - before[2]) / dt
