"""A haptic stylus without the hardware: a point mass with the device's own damping, in a box, and a free gimbal."""

from dataclasses import dataclass, field
from typing import NamedTuple

Vector = tuple[float, float, float]

RATE_HZ = 1000.0
"""At which a haptic device closes its force loop."""


class StylusState(NamedTuple):
    """Where the tip of the stylus is, relative to the device's neutral pose, in base axes.

    Attributes:
        position: [m].
        velocity: [m/s].
        rotation: Of the handle, rotation vector [rad].
    """

    position: Vector = (0.0, 0.0, 0.0)
    velocity: Vector = (0.0, 0.0, 0.0)
    rotation: Vector = (0.0, 0.0, 0.0)


@dataclass
class Stylus:
    """m dv/dt = F - c v, and no further than `reach` on each axis; the handle turns as the fingers turn it.

    Integrated with the velocity first and the damping implicit: it never gains energy of its own. Plain floats, since
    a thousand steps a second in NumPy would cost more than the rest of the process.

    Attributes:
        mass: what the hand feels at the tip, the fingers on it included [kg].
        damping: of the device itself [N s/m].
        reach: half the edge of the workspace [m].
        state: the newest.
    """

    mass: float = 0.15
    damping: float = 0.3
    reach: float = 0.25
    state: StylusState = field(default_factory=StylusState)

    def step(self, force: Vector, dt: float, rotation: Vector | None = None) -> StylusState:
        """Move on by dt [s].

        Args:
            force: Of hand and motors together [N].
            dt: [s].
            rotation: How the fingers hold the handle [rad]; without fingers the gimbal, which has neither motors nor
                springs, stays as it is.
        """
        (px, py, pz), (vx, vy, vz), turned = self.state
        fx, fy, fz = force
        px, vx = self._axis(px, vx, fx, dt)
        py, vy = self._axis(py, vy, fy, dt)
        pz, vz = self._axis(pz, vz, fz, dt)
        self.state = StylusState((px, py, pz), (vx, vy, vz), turned if rotation is None else rotation)
        return self.state

    def _axis(self, position: float, velocity: float, force: float, dt: float) -> tuple[float, float]:
        v = (velocity + dt * force / self.mass) / (1.0 + dt * self.damping / self.mass)
        p = position + dt * v
        if abs(p) > self.reach:
            return (self.reach if p > 0.0 else -self.reach), 0.0
        return p, v
