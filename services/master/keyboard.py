"""The keys of the operator's page as a master: rate control with a dead man's switch."""

from __future__ import annotations

from collections.abc import Collection

from protocol.messages import Figure, Vector3
from services.config import Keyboard
from services.master.device import ZERO, Moment, Sample

KEYS: dict[str, tuple[int, int]] = {
    "KeyQ": (0, +1),
    "KeyA": (0, -1),
    "KeyW": (1, +1),
    "KeyS": (1, -1),
    "KeyE": (2, +1),
    "KeyD": (2, -1),
}
"""Physical keys (`KeyboardEvent.code`) to axis and sign, as in the thesis."""

LET_GO_S = 0.2
"""Within this time the displacement is zero after focus, tab, link or process was lost [s]."""


def directions(keys: Collection[str]) -> tuple[int, int, int]:
    """Which way each axis is pushed: -1, 0 or 1; keys against each other cancel out."""
    axes = [0, 0, 0]
    for key in set(keys) & KEYS.keys():
        axis, sign = KEYS[key]
        axes[axis] += sign
    return (axes[0], axes[1], axes[2])


def pushed(displacement: float, direction: int, dt: float, law: Keyboard) -> float:
    """One axis of the displacement after dt [s]: grows while a key is held, decays to zero without [m]."""
    if direction == 0:
        return _towards_zero(displacement, law.decay * dt)
    return max(-law.reach, min(law.reach, displacement + direction * law.growth * dt))


def _towards_zero(value: float, distance: float) -> float:
    return max(0.0, value - distance) if value > 0.0 else min(0.0, value + distance)


class KeyboardMaster:
    """Turns held keys into a displacement, as fast as the clock goes and not as fast as messages come.

    A key counts only while an episode is being refined and the page's newest state is fresh and focused.
    Otherwise nobody is at the device: it disengages at once and its displacement falls to zero within
    `LET_GO_S`. Whoever engages it takes over the correction as the robot applies it then: a held robot does not
    jump back because its operator, or this process, was away.

    Args:
        law: growth, decay and reach.
    """

    name = "keyboard"

    def __init__(self, law: Keyboard) -> None:
        self._law = law
        self._displacement = ZERO
        self._engaged = False

    def step(self, moment: Moment) -> Sample:
        """Advance by the time that has passed."""
        robot, operator = moment.refining, moment.operator
        if robot is None or operator is None or not operator.focused:
            return self._let_go(moment.dt)
        before = self._displacement if self._engaged else self._within_reach(robot.offset)
        x, y, z = (
            pushed(d, way, moment.dt, self._law) for d, way in zip(before, directions(operator.keys), strict=True)
        )
        self._displacement, self._engaged = (x, y, z), True
        return Sample(self._displacement, _velocity(before, self._displacement, moment.dt), engaged=True)

    def figures(self) -> tuple[Figure, ...]:
        """A keyboard measures nothing."""
        return ()

    def close(self) -> None:
        """There is no hardware to let go of."""

    def _let_go(self, dt: float) -> Sample:
        before, distance = self._displacement, self._law.reach / LET_GO_S * dt
        x, y, z = (_towards_zero(d, distance) for d in before)
        self._displacement, self._engaged = (x, y, z), False
        return Sample(self._displacement, _velocity(before, self._displacement, dt), engaged=False)

    def _within_reach(self, displacement: Vector3) -> Vector3:
        x, y, z = (max(-self._law.reach, min(self._law.reach, d)) for d in displacement)
        return (x, y, z)


def _velocity(before: Vector3, after: Vector3, dt: float) -> Vector3:
    if dt <= 0.0:
        return ZERO
    return (after[0] - before[0]) / dt, (after[1] - before[1]) / dt, (after[2] - before[2]) / dt
