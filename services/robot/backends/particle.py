"""The particle of the thesis' 2D example in an arm's place: three slides without mass, friction or delay."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from services.robot.backends.backend import CONTROL_PERIOD, Blocked, NativeLimits, Observation, Status, Touch
from services.robot.backends.gate import Gate
from services.robot.correction import Correction
from services.robot.mechanism import Unreachable
from sim.pose import Pose
from sim.tasks.particle import ParticleScene
from sim.tasks.scene import NO_ROTATION, Box, Group

Array = NDArray[np.float64]

JOINTS = ("particle_x", "particle_y", "particle_z")

_REACH = 0.5  # [m] of each slide, to both sides
_SPEED = 1.0  # [m/s] of each slide
_ACCELERATION, _JERK = 1e3, 1e6  # [m/s^2, m/s^3] no limits: from speed to speed in any period, as what has no mass
_FLAT = 1e-6  # [m, or of a quaternion] that a start may lie beside the plane
_STEPS = 5  # of a control period, at which it is looked whether the particle touches something
_SHARES = np.linspace(0.0, 1.0, _STEPS + 1)[1:, None]  # of a period's way, after each of them
_APART = 1e3  # [m] what has one part only is as far from itself as can be said


class ParticleKinematics:
    """The joint positions are the position; the orientation never changes. See `Mechanism`.

    Args:
        axes: base axes along which an operator can displace the particle, 1 or 0 each.
    """

    def __init__(self, axes: Sequence[float]) -> None:
        self.lower: Array = np.full(3, -_REACH)
        self.upper: Array = np.full(3, _REACH)
        self.velocity_limit: Array = np.full(3, _SPEED)
        self.acceleration_limit: Array = np.full(3, _ACCELERATION)
        self.jerk_limit: Array = np.full(3, _JERK)
        self.turn_slack = 0.0
        self._axes: Array = np.array(axes)

    def forward(self, q: Array) -> Pose:
        """Where the particle is."""
        return Pose(q.copy(), np.array(NO_ROTATION))

    def admitted(self, wanted: Correction) -> Correction:
        """Its displacement along the axes; a point cannot be turned."""
        return replace(wanted, offset=self._axes * wanted.offset, turn=np.zeros(3))

    def solve_step(self, q: Array, position: Array, orientation: Array, dt: float) -> tuple[Array, Array]:
        """Straight to the position, each slide as fast as it may."""
        del orientation
        longest = dt * self.velocity_limit
        wanted = np.minimum(np.maximum(position, self.lower), self.upper)  # in half the time of np.clip
        step = np.minimum(np.maximum(wanted - q, -longest), longest)
        return q + step, step / dt

    def solve(self, position: Array, orientation: Array, seeds: Sequence[Array], rng: np.random.Generator) -> Array:
        """The position itself, in the plane and without a rotation."""
        del seeds, rng
        inside = np.all((self.lower <= position) & (position <= self.upper))
        if not (inside and abs(position[2]) <= _FLAT and abs(orientation @ NO_ROTATION) >= 1.0 - _FLAT):
            raise Unreachable(position)
        return position.copy()

    def dexterity(self, q: Array) -> float:
        """It moves every way as well as any other."""
        del q
        return 1.0

    def self_distance(self, q: Array) -> float:
        """As far as can be said."""
        del q
        return _APART


class ParticleBackend:
    """Is where it is told to be at the end of each period; nothing stops it, but what it touches is told.

    Args:
        scene: that it moves in.
        variant: of the scene, at first.

    Raises:
        UnknownVariant: the scene has no such variant.
    """

    def __init__(self, scene: ParticleScene, variant: str) -> None:
        self._scene = scene
        self._gate = Gate(JOINTS, lambda: self._q)
        self._periods = 0
        self.reset(scene.training_positions[0], variant, scene.posture)

    @property
    def joint_names(self) -> tuple[str, ...]:
        """The slides along the base axes."""
        return JOINTS

    @property
    def limits(self) -> NativeLimits:
        """The slides' ends; nothing else holds what has no mass."""
        unlimited = np.full(3, np.inf)
        return NativeLimits(np.full(3, -_REACH), np.full(3, _REACH), unlimited, unlimited, unlimited)

    @property
    def variant(self) -> str:
        """Of the scene."""
        return self._variant

    def connect(self) -> None:
        """It is there already."""
        self._gate.connect()

    def close(self) -> None:
        """Nothing moves without periods that elapse."""
        self._gate.close()

    def status(self) -> Status:
        """As it was told: nothing of it can fail."""
        return self._gate.status(self._now)

    def hold(self) -> None:
        """It is where it is: without mass it stands at once."""
        self._gate.hold()
        self._stand()

    def stop(self, reason: str) -> None:
        """As `hold`, until `recover`."""
        self._gate.stop(reason)
        self._stand()

    def recover(self) -> None:
        """What stopped it was said, and no more than that."""
        self._gate.recover()

    def reset(self, place: Array, variant: str, q: Array) -> None:
        """Put the particle at q and the via-points at their y, shape (2,) [m]."""
        solid = tuple(box for box in self._scene.boxes(variant) if box.group is not Group.DETAIL)
        touch = self._touched(solid, q[None])
        if touch is not None:
            raise Blocked(*touch.between)
        self._solid = solid
        self._touch: Touch | None = None
        self._variant = variant
        self._condition = place.copy()
        self._q, self._qd, self._time = q.copy(), np.zeros(3), 0.0
        self.hold()

    def command(self, q: Array, qd: Array, opening: float) -> None:
        """Where to be, and how fast, at the period's end; it has no gripper."""
        del opening
        self._gate.admit(q, self._now)
        self._command = q.copy(), qd.copy()

    def elapse(self) -> None:
        """One control period, of which the particle spends an equal part on each part of its way."""
        if self._gate.silent(self._now):
            self._stand()
        before = self._q
        self._q, self._qd = self._command
        self._touch = self._touched(self._solid, before + _SHARES * (self._q - before))
        self._time += CONTROL_PERIOD
        self._periods += 1

    def observe(self) -> Observation:
        """Exactly where everything is; the second via-point stands in an object's place."""
        goal = np.array([self._scene.via_x[-1], self._condition[-1], 0.0])
        return Observation(
            time=self._time,
            q=self._q.copy(),
            qd=self._qd.copy(),
            object_pose=Pose(goal, np.array(NO_ROTATION)),
            touch=self._touch,
            world=np.concatenate([self._q, self._condition]),
            condition=self._condition.copy(),
        )

    @property
    def _now(self) -> float:
        """Of the periods that have elapsed, resets or not [s]."""
        return self._periods * CONTROL_PERIOD

    def _stand(self) -> None:
        self._command = self._q, np.zeros(3)

    def _touched(self, solid: Sequence[Box], way: Array) -> Touch | None:
        """The first box that the particle reaches into on its way, shape (n, 3); it weighs nothing: without a force."""
        for box in solid:
            nearest = _nearest(box, way)
            (reached,) = np.nonzero(np.linalg.norm(nearest - way, axis=1) <= self._scene.radius)
            if len(reached):
                return Touch(nearest[reached[0]], 0.0, ("particle", box.name))
        return None


def _nearest(box: Box, points: Array) -> Array:
    """The points of an upright box that are nearest to others, shape (n, 3) [m]."""
    centre, half = np.array(box.centre), np.array(box.half_sizes)
    return np.clip(points, centre - half, centre + half)
