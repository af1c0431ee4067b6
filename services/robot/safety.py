"""What keeps the robot from moving: the watchdog, and the limits on each command.

Nothing here knows a clock or a bus: ages and requests are passed in, decisions and reasons come out.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lfd.motion.rotations import slerp
from services.process.config import LONGEST_SILENCE_S
from services.robot.correction import Correction
from sim.pose import Pose

Array = NDArray[np.float64]

REFERENCE_SPEED = 1.2  # [m/s] that the reference has at most
REFERENCE_TURN_SPEED = 1.5  # [rad/s] that it turns at most: at twice as much the arm is left behind by decimetres
DISPLACEMENT_REACH = 0.3  # [m] of the operator's correction
ROTATION_REACH = 1.0  # [rad] of the operator's correction
STANDING_SPEED = 0.01  # [rad/s, torso m/s] of the fastest joint, below which the robot stands
SLOWING_S = 0.05  # [s] before a silence becomes a hold, in which the motion comes to rest; five of the master's samples
ROUNDING = 1e-9  # by which a limit may be exceeded: less than any joint or gripper shows
FORCE_STOP = 300.0  # [N] of a touch, above which the arm stops; running into a wall gives half of it


@dataclass(frozen=True)
class Watchdog:
    """Lets a motion go on only while its operator is present, and a refinement only while the master is heard.

    No setting lifts `LONGEST_SILENCE_S`.

    Attributes:
        hold_after_s: age that is tolerated of the newest master state [s].
        presence_after_s: age that is tolerated of the authority's newest renewal [s].
    """

    hold_after_s: float
    presence_after_s: float

    def presence(self, holder: str, silence_s: float | None) -> str:
        """Why nobody may move the robot now; empty where somebody may.

        Args:
            holder: of the authority, empty for nobody.
            silence_s: time since its newest renewal, in the robot's clock [s]; None without any.
        """
        if not holder:
            return "nobody holds the authority"
        limit = min(LONGEST_SILENCE_S, self.presence_after_s)
        if silence_s is None or not silence_s <= limit:
            return f"no operator was present for more than {limit * 1e3:.0f} ms"
        return ""

    def hand(self, silence_s: float | None, *, engaged: bool, way_s: float = 0.0) -> str:
        """Why the master does not count now; empty where it does.

        Args:
            silence_s: age of its newest state under the authority, in the robot's clock [s]; None without any.
            engaged: that state says that a hand is on it.
            way_s: how long it took to come, as far as that is known [s].
        """
        limit = min(LONGEST_SILENCE_S, self.hold_after_s)
        if silence_s is None:
            return "nothing was heard of the operator's keys or device under this authority"
        if not silence_s <= limit:
            return f"the operator's keys or device were not heard for more than {limit * 1e3:.0f} ms"
        if not silence_s + way_s <= LONGEST_SILENCE_S:
            return f"the operator's keys or device are heard more than {LONGEST_SILENCE_S * 1e3:.0f} ms late"
        return "" if engaged else "no hand is at the operator's keys or device"

    def leeway(self, absence_s: float | None, silence_s: float | None = 0.0, way_s: float = 0.0) -> float:
        """How far the silence is from a hold: 1 where the motion may go at its pace, falling to 0 where it is to stand.

        Args:
            absence_s: time since the authority's newest renewal [s]; None without any.
            silence_s: age of the master's newest state, where that counts [s]; None without any.
            way_s: how long it took to come, as far as that is known [s].
        """
        if absence_s is None or silence_s is None:
            return 0.0
        return min(
            _left(absence_s, self.presence_after_s),
            _left(silence_s, self.hold_after_s),
            _left(silence_s + way_s, LONGEST_SILENCE_S),
        )


def _left(silence_s: float, limit_s: float) -> float:
    """Share of the slowing down that lies ahead; where next to no silence is tolerated half of that is left for it."""
    limit_s = min(LONGEST_SILENCE_S, limit_s)
    return min(1.0, max(0.0, (limit_s - silence_s) / min(SLOWING_S, 0.5 * limit_s)))


@dataclass(frozen=True, eq=False)
class JointLimits:
    """What the joints may do.

    Attributes:
        names: of the joints.
        lower: least positions, shape (m,).
        upper: greatest positions, shape (m,).
        speed: greatest speeds, shape (m,).
    """

    names: tuple[str, ...]
    lower: Array
    upper: Array
    speed: Array

    def clamp(self, q: Array, wanted: Array, period: float) -> tuple[Array, tuple[str, ...]]:
        """The furthest step towards the wanted positions that the limits allow.

        A step that is too fast for one joint is shortened for all, so that its direction stays.

        Args:
            q: positions now, shape (m,).
            wanted: positions at the end of the period, shape (m,).
            period: [s].

        Returns:
            Positions at the end of the period, and what was clamped where.
        """
        bounded = np.minimum(np.maximum(wanted, self.lower), self.upper)  # in half the time of np.clip
        beyond = np.abs(bounded - wanted) > ROUNDING
        step = bounded - q
        use = np.abs(step) / (self.speed * period)
        too_fast = use > 1.0 + ROUNDING
        clamped = (*self._named("position", beyond), *self._named("speed", too_fast))
        return q + step / max(1.0, float(use.max())), clamped

    def _named(self, limit: str, exceeded: NDArray[np.bool_]) -> list[str]:
        return [f"{limit} {self.names[i]}" for i in exceeded.nonzero()[0]]


def clamp_length(vector: Array, longest: float) -> tuple[Array, bool]:
    """The vector, shape (3,), shortened to at most `longest`, and whether that was necessary."""
    length = math.sqrt(vector @ vector)
    if length <= longest * (1.0 + ROUNDING):
        return vector, False
    return vector * (longest / length), True


def clamp_correction(wanted: Correction) -> tuple[Correction, tuple[str, ...]]:
    """The operator's correction within its reach, and what was clamped."""
    offset, displaced = clamp_length(wanted.offset, DISPLACEMENT_REACH)
    turn, rotated = clamp_length(wanted.turn, ROTATION_REACH)
    return Correction(offset, turn, wanted.opening), _named(("displacement", displaced), ("rotation", rotated))


def clamp_reference(previous: Pose, wanted: Pose, period: float) -> tuple[Pose, tuple[str, ...]]:
    """The wanted reference, no further from the previous one than its two speeds allow, and what was clamped.

    Args:
        previous: reference, one period ago.
        wanted: reference now.
        period: [s].
    """
    step, moved = clamp_length(wanted.position - previous.position, REFERENCE_SPEED * period)
    orientation, turned = _clamp_turn(previous.orientation, wanted.orientation, REFERENCE_TURN_SPEED * period)
    if not (moved or turned):
        return wanted, ()
    position = previous.position + step if moved else wanted.position
    return Pose(position, orientation), _named(("reference speed", moved), ("reference turn speed", turned))


def _clamp_turn(previous: Array, wanted: Array, widest: float) -> tuple[Array, bool]:
    """The wanted orientation, turned from the previous one by at most `widest` [rad], and whether that was less."""
    cosine = abs(float(previous @ wanted))  # of half the angle, whichever signs the two quaternions have
    if cosine >= math.cos(0.5 * widest * (1.0 + ROUNDING)):
        return wanted, False
    return slerp(previous, wanted, np.asarray(widest / (2.0 * math.acos(cosine)))), True


def _named(*clamps: tuple[str, bool]) -> tuple[str, ...]:
    return tuple(name for name, clamped in clamps if clamped)


def self_collision(distance: float, previous: float, limit: float) -> bool:
    """Whether the robot comes too close to itself: under the limit and still closing in, so that it may move away."""
    return distance < limit and distance < previous


def too_forceful(force: float) -> bool:
    """Whether a touch pushes harder than any motion should [N]."""
    return force > FORCE_STOP


def standing(speeds: Array) -> bool:
    """Whether every joint was measured to stand still; speeds of shape (m,) [rad/s, torso m/s]."""
    return bool(np.all(np.abs(speeds) <= STANDING_SPEED))
