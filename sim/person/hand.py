"""A scripted operator's hand and eyes: sees late and not quite, moves smoothly, trembles, pushes until all seems right.

The arm is an impedance about the place where it wants the stylus to be (Hogan 1985). The wrist turns the stylus, whose
gimbal has neither motors nor inertia worth mentioning: what the wrist does is what the stylus does (thesis, V-B: the
device has no torque feedback). The hand has no access to anything that a person in front of the screen would not see.
"""

from collections import deque
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sim.person.attention import GLANCE, REACTION
from sim.person.intention import Intention
from sim.person.itinerary import Itinerary
from sim.person.limb import DELAY, Ability, Limb
from sim.person.sight import Sight
from sim.person.stylus import StylusState, Vector
from sim.pose import Pose
from sim.rotations import rotation_to
from sim.tasks.scene import Eye

Array = NDArray[np.float64]

STIFFNESS = 500.0  # [N/m]
DAMPING = 15.0  # [N s/m]
ARM = Ability(speed=0.25, push=0.06, tremor=0.0015)  # [m]
WRIST = Ability(speed=1.0, push=0.2, tremor=0.005)  # [rad]
_ROBOT_DELAY = 0.3  # [s] that a person learns to expect between the stylus and the robot
_LEAD = DELAY + _ROBOT_DELAY  # [s] that a practised person acts ahead of a motion they know
_STANDS = 1e-6  # [1/s] of progress, below which the robot is seen to stand
_GRIP_TOLERANCE = 0.01  # [m] between stylus and robot at which the clutch is closed
_GRIP_TURN_TOLERANCE = 0.05  # [rad] the same of their rotations
_ROOM = 0.18  # [m] from the middle of the workspace, beyond which the hand lets go and comes back
_BACK = 0.02  # [m] from there at which it takes the robot up again
_LONGEST_STEP = 0.05  # [s] a hand that was not asked for longer did not move meanwhile


@dataclass(frozen=True, eq=False)
class Seen:
    """What the screen shows, and the stylus in the hand.

    Attributes:
        progress: Of the episode, from 0 to 1.
        robot: Pose of the grasping frame.
        offset: Of the robot from its prediction, shape (3,) [m].
        turn: The same of its orientation, rotation vector in base axes, shape (3,) [rad].
        stylus: Where it is and how it is turned.
    """

    progress: float
    robot: Pose
    offset: Array
    turn: Array
    stylus: StylusState


class _Aim(NamedTuple):
    """What a limb wants, and the robot's error that it sees, each of shape (3,)."""

    wanted: Array
    error: Array


class Hand:
    """Holds the stylus for one episode at a time.

    Between `grip` and `release` call `observe` at about 100 Hz, and `force` at the device's own rate.

    Args:
        seed: Of the tremor, and of what is misjudged.
        misjudgement: Of depth, see `Sight` [m].
    """

    def __init__(self, seed: int, misjudgement: float = 0.0) -> None:
        self._arm = Limb(ARM, np.random.default_rng(seed))
        self._wrist = Limb(WRIST, np.random.default_rng((seed, 1)))
        self._of_sight = np.random.default_rng((seed, 2))
        self._misjudgement = misjudgement
        self._sight: Sight | None = None
        self._correction: Intention | None = None
        self._memory: deque[tuple[float, Seen]] = deque()
        self._target: Vector | None = None
        self._rotation: Vector | None = None
        self._clutched = False
        self._itinerary: Itinerary | None = None
        self._opening: float | None = None

    @property
    def clutched(self) -> bool:
        """The stylus is where the robot is: from here on the robot may follow it."""
        return self._clutched

    @property
    def opening(self) -> float | None:
        """What is asked of the gripper [m]; None where it is left to the robot."""
        return self._opening

    @property
    def rotation(self) -> Vector | None:
        """How the wrist turns the stylus, rotation vector in base axes; None while the hand is off [rad]."""
        return self._rotation

    def grip(self, correction: Intention, stylus: StylusState, eye: Eye | None = None) -> None:
        """Take the stylus where it is, with a correction in mind.

        Args:
            correction: What the operator wants.
            stylus: Where it is.
            eye: From where they look; a bystander's by default.
        """
        self._take(stylus, eye)
        self._correction = correction

    def take_up(self, itinerary: Itinerary, stylus: StylusState, eye: Eye | None = None) -> None:
        """Take the stylus where it is, to lead a robot that nothing else leads.

        Args:
            itinerary: Where to.
            stylus: Where it is.
            eye: See `grip`.
        """
        self._take(stylus, eye)
        self._itinerary, self._clutched = itinerary, True

    def release(self) -> None:
        """Let go."""
        self._correction = self._itinerary = self._opening = None
        self._target = self._rotation = None
        self._clutched = False

    def observe(self, time: float, seen: Seen) -> Vector | None:
        """Look at the screen and decide where the stylus should be; None while the hand is off.

        Args:
            time: Of any clock that does not go back [s].
            seen: What it shows now.
        """
        if self._correction is None:
            return None
        dt, noticed = self._notice(time, seen)
        self._clutched = self._clutched or _together(seen)
        arm, wrist = self._follow(self._correction, noticed) if self._clutched else self._take_over(noticed)
        self._arm.move(*arm, dt)
        self._wrist.move(*wrist, dt)
        self._target, self._rotation = _vector(self._arm.position), _vector(self._wrist.position)
        return self._target

    def lead(self, time: float, seen: Seen) -> bool:
        """Look at the robot and lead it on; whether it stands where it was led to. See `observe`."""
        itinerary = self._itinerary
        if itinerary is None or itinerary.over:
            return False
        dt, noticed = self._notice(time, seen)
        _, then = self._memory[noticed]
        away = itinerary.aim.position - then.robot.position
        turned = rotation_to(then.robot.orientation, itinerary.aim.orientation)
        here, stood = np.array(seen.stylus.position), np.array(then.stylus.position)
        self._clutched = bool(np.max(np.abs(here)) < (_ROOM if self._clutched else _BACK))
        still = np.zeros(3)
        if not self._clutched:  # back to the middle, where nothing that the hand does moves the robot
            self._arm.move(still, still, dt)
            self._target = _vector(self._arm.position)
            return False
        self._arm.move(stood + away, still, dt)
        self._wrist.move(then.stylus.rotation + turned, still, dt)
        self._target, self._rotation = _vector(self._arm.position), _vector(self._wrist.position)
        led = np.subtract(seen.stylus.rotation, then.stylus.rotation)
        self._opening = itinerary.opening
        return itinerary.arrived(time, np.concatenate([away - (here - stood), turned - led]))

    def force(self, stylus: StylusState) -> Vector:
        """The force on the stylus, F = K_h (target - x) - D_h v, none while the hand is off [N]."""
        target = self._target
        if target is None:
            return (0.0, 0.0, 0.0)
        (tx, ty, tz), (x, y, z), (vx, vy, vz) = target, stylus.position, stylus.velocity
        return (
            STIFFNESS * (tx - x) - DAMPING * vx,
            STIFFNESS * (ty - y) - DAMPING * vy,
            STIFFNESS * (tz - z) - DAMPING * vz,
        )

    def _take(self, stylus: StylusState, eye: Eye | None) -> None:
        self.release()
        self._sight = Sight(np.array((eye or Eye()).position), self._misjudgement, self._of_sight)
        self._memory.clear()
        self._arm.rest(np.array(stylus.position))
        self._wrist.rest(np.array(stylus.rotation))
        self._target, self._rotation = stylus.position, stylus.rotation

    def _notice(self, time: float, seen: Seen) -> tuple[float, int]:
        """The time since the look before, and which look has reached the person by now."""
        dt = min(time - self._memory[-1][0], _LONGEST_STEP) if self._memory else 0.0
        self._memory.append((time, self._look(seen, dt)))
        while len(self._memory) > 1 and self._memory[1][0] <= time - REACTION - GLANCE:
            self._memory.popleft()
        return dt, max((i for i, (then, _) in enumerate(self._memory) if then <= time - REACTION), default=0)

    def _look(self, seen: Seen, dt: float) -> Seen:
        """What of the screen reaches the person."""
        if self._sight is None:
            return seen
        return replace(seen, robot=Pose(self._sight.look(seen.robot.position, dt), seen.robot.orientation))

    def _take_over(self, noticed: int) -> tuple[_Aim, _Aim]:
        """Before the clutch closes: bring the stylus to where the robot stands."""
        _, seen = self._memory[noticed]
        return _Aim(seen.offset, seen.offset - seen.stylus.position), _Aim(seen.turn, seen.turn - seen.stylus.rotation)

    def _follow(self, correction: Intention, noticed: int) -> tuple[_Aim, _Aim]:
        """Act ahead of what is known, the way, from the pace that was seen; react to where the robot seemed to go."""
        (before, glimpsed), (then, seen), (now, _) = self._memory[0], self._memory[noticed], self._memory[-1]
        pace = (seen.progress - glimpsed.progress) / (then - before) if then > before else 0.0
        ahead = seen.progress + (now - then + _LEAD) * pace
        away = turned = np.zeros(3)
        if pace > _STANDS:  # a robot that stands still is waiting: pushing harder would only make it jump later
            place = correction.pose(seen.progress)
            away = place.position - seen.robot.position
            turned = rotation_to(seen.robot.orientation, place.orientation)
        self._opening = correction.opening(ahead)
        return _Aim(correction.displacement(ahead), away), _Aim(correction.rotation(ahead), turned)


def _together(seen: Seen) -> bool:
    """The stylus stands as the robot's correction does."""
    away, turned = seen.offset - seen.stylus.position, seen.turn - seen.stylus.rotation
    return bool(np.linalg.norm(away) < _GRIP_TOLERANCE and np.linalg.norm(turned) < _GRIP_TURN_TOLERANCE)


def _vector(values: Array) -> Vector:
    x, y, z = values.tolist()
    return (x, y, z)
