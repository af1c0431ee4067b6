"""Executes a prediction at the control rate and merges the operator's correction into it.

Equations (15) to (17) of the thesis move the NEXT way-point by the master's displacement d:

    p_new(i+1) = p(i) + (p(i+1) - p(i)) + d = p(i+1) + d.

Written as a correction o on top of the prediction, that is o(i+1) = d: whatever the correction is now, it is to equal
the displacement one way-point interval, the look-ahead L = T / (n - 1), later. Between two way-points the thesis' arm
goes there on a straight line. At the control rate the same rule is applied in every period anew, with the newest
displacement: the course is set from o so that it would meet d one look-ahead later, a slope of (d - o) / L. The horizon
recedes with every period, so that

    do/dt = (d - o) / L,    exactly    o(t + h) = o(t) + (1 - exp(-h / L)) (d - o(t))

over a period h in which d stands still. Without input the prediction is tracked exactly, each new sample acts in the
next period, nothing jumps, and after release the correction returns to zero in the same way. Adapting the CURRENT
way-point (eq. B.7) is the limit L = 0: o = d at once.

The time t is the prediction's. At another pace it passes faster or more slowly, and o with it: the pace changes when
the arm is somewhere, never where it goes. In a pause both stand still; on the way back o is what it was there.

The thesis corrects positions only and recommends orientations next (V-B). Here a rotation vector r in base axes follows
the master's rotation by the same law, and rotates the orientation that is predicted: R_new = exp(r) R. On its way r
does not leave the ball that the master's reach spans, far from where rotation vectors wrap around.
"""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lfd.motion.part import WHOLE, Part
from lfd.motion.rotations import conjugate, log_map, multiply, slerp
from lfd.motion.trajectory import Trajectory
from services.robot.correction import UNCORRECTED, Correction
from services.robot.easing import Easing, eased
from services.robot.grasp import Grasp
from services.robot.pace import Pace
from services.robot.passage import Passage
from services.robot.path import Path
from sim.pose import Pose

Array = NDArray[np.float64]

RAMP_MIN_S = 0.5  # [s]
RAMP_SPEED = 0.15  # [m/s] mean
RAMP_TURN_SPEED = 0.5  # [rad/s] mean
STILL_THERE = 0.01  # [m] from where it should be, an arm goes on after a short hold without a ramp
STILL_TURNED = 0.1  # [rad] the same of its orientation
INPUT_THRESHOLD = 0.0005  # [m] a displacement above this counts as the operator's input
TURN_THRESHOLD = 0.005  # [rad] a rotation above this does too: it moves what lies 0.1 m from its axis as far


def look_ahead(prediction: Trajectory) -> float:
    """L of the prediction: the time between two of its way-points [s]."""
    return prediction.duration / (prediction.n_points - 1)


class Execution:
    """One prediction on its way: first a ramp from where the arm is, then the prediction plus the correction.

    Not calling `advance` is a hold: time stands still, the correction is frozen, the reference stays. From a hold
    in the middle of the way the motion goes on from rest, see `Easing`.

    Args:
        measured: pose of the grasping frame now.
        prediction: in the base frame, any number of way-points.
        look_ahead: L, after which the correction is to equal the operator's [s]; 0 moves the current way-point.
        period: of the control [s].
        part: of the prediction in which the operator's correction counts; elsewhere none is asked for.
        inert: what follows it needs time to gain and to lose its speed: a motion that begins or ends at speed is begun
            from rest and brought to rest.
    """

    def __init__(
        self,
        measured: Pose,
        prediction: Trajectory,
        look_ahead: float,
        period: float,
        part: Part = WHOLE,
        *,
        inert: bool = False,
    ) -> None:
        self._path = Path(prediction, period)
        self._begins_fast = inert and self._path.begins_fast
        self._ends_fast = inert and self._path.ends_fast
        self._passage = Passage()
        self._period = period
        self._at = 0.0  # [control periods]
        self.part = part
        self.look_ahead = look_ahead
        self.prediction = prediction
        self.correction: Correction = UNCORRECTED
        self.pace = Pace(period)
        self._easing = Easing(period)
        self._grasp = Grasp()
        self._ramp = Ramp(measured, self.nominal, period)

    @property
    def ramping(self) -> bool:
        """The prediction's time stands still while the arm goes to where it left off."""
        return not self._ramp.finished

    @property
    def finished(self) -> bool:
        """The last way-point is the reference."""
        return not self.ramping and self._at == self._path.end

    @property
    def corrects(self) -> bool:
        """The operator's correction counts: the motion goes on, and is in the part that is corrected."""
        first, last = self.part
        return not self.ramping and self.pace.rate > 0.0 and first <= self.progress <= last

    @property
    def points(self) -> int:
        """Of the account of it: as many way-points as are predicted."""
        return self.prediction.n_points

    @property
    def time(self) -> float:
        """Of the prediction [s]."""
        return self._path.time(self._at)

    @property
    def progress(self) -> float:
        """Share of the prediction that lies behind."""
        return self._at / self._path.end

    @property
    def nominal(self) -> Pose:
        """What the prediction alone says now."""
        return self._path.pose(self._at)

    @property
    def opening(self) -> float | None:
        """How far the gripper should be open now [m]; None on the ramp, and where nobody says: it stays as it is."""
        if self.ramping:
            return None
        kept = self.correction.opening
        return self._path.opening(self._at) if kept is None else kept

    @property
    def reference(self) -> Pose:
        """Where the grasping frame should be now."""
        return self._ramp.pose if self.ramping else self._corrected()

    def go(self, rate: float, until: float | None = None) -> None:
        """Go on at another pace.

        Args:
            rate: of the prediction's time; 0 pauses, a negative one goes back along the motion that was executed. A
                ramp takes its own time at 1 and more, longer at less, and stands in a pause.
            until: share of the prediction at which to pause; None to go on to its end.
        """
        self.pace.ask(rate, None if until is None else until * self._path.end)

    def advance(self, wanted: Correction, leeway: float = 1.0, share: float = 1.0) -> Pose:
        """Go on by one control period.

        Args:
            wanted: the correction that the operator asks for; ignored on the ramp, on the way back, and outside the
                part that is corrected.
            leeway: see `Watchdog.leeway`.
            share: of its pace at which the joints let it go on.

        Returns:
            The reference at the end of the period.
        """
        if self.finished:
            return self.reference
        paced = share * self.pace.step(self._at)
        step = paced * self._easing.share(leeway)
        if self.ramping:
            self._ramp.advance(min(1.0, abs(step)))
            if not self.ramping and (self._at > 0.0 or self._begins_fast):
                self._easing.rest()
        elif step > 0.0:
            if self._ends_fast:
                step = min(step, self.pace.stopping(self._path.end - self._at))
            self._go_on(step, wanted, paced * eased(leeway))
        elif step < 0.0:
            self._at = max(0.0, self._at + step)
            self.correction = self._passage.go_back(self._at)
        return self.reference

    def _go_on(self, step: float, wanted: Correction, following: float) -> None:
        """By a step, in which the correction follows for another one [control periods]."""
        first, last = self.part
        counts = first <= self.progress <= last
        asked = wanted if counts else UNCORRECTED
        gain = -math.expm1(-following * self._period / self.look_ahead) if self.look_ahead > 0.0 else 1.0
        before = self._path.opening(self._at)
        self._at += step
        if self._path.is_over(self._at):
            self._at = float(self._path.end)
        own = before, self._path.opening(self._at)
        grasp = self._grasp.asked(wanted.opening, self.correction.opening, own, counts=counts)
        self.correction = replace(self.correction.towards(asked, gain), opening=grasp)
        self._passage.go_on(self._at, self.correction)

    def is_input(self, wanted: Correction) -> bool:
        """What is wanted is more than a device's noise, or something of the gripper."""
        if wanted.opening is not None and self.corrects:
            return True
        displaced = float(np.linalg.norm(wanted.offset)) > INPUT_THRESHOLD
        return displaced or float(np.linalg.norm(wanted.turn)) > TURN_THRESHOLD

    def rejoin(self, measured: Pose, *, at_once: bool) -> None:
        """Go on after a hold: with a ramp from the measured pose to where the prediction was left.

        Args:
            measured: pose of the grasping frame now.
            at_once: do without the ramp, where the arm still is where it should be; a ramp that the hold interrupted
                goes on then too, so that holds which come often do not keep the arm from its end.
        """
        if not (at_once and _close(measured, self.reference)):
            self._ramp = Ramp(measured, self._corrected(), self._period)
        if self._ramp.begun:
            self._easing.rest()
        else:
            self._easing.begin()

    def _corrected(self) -> Pose:
        return self.correction.of(self.nominal)


class Ramp:
    """A smooth motion between two poses, at rest on both ends: the minimum-jerk profile (Flash and Hogan, 1985).

    Args:
        start: where it begins.
        goal: where it ends.
        period: of the control [s].
    """

    def __init__(self, start: Pose, goal: Pose, period: float) -> None:
        self.start = start
        self.goal = goal
        distance = float(np.linalg.norm(goal.position - start.position))
        angle = angle_between(start.orientation, goal.orientation)
        self._ticks = round(max(RAMP_MIN_S, distance / RAMP_SPEED, angle / RAMP_TURN_SPEED) / period)
        self._tick = 0.0

    @property
    def begun(self) -> bool:
        """The start was left."""
        return self._tick > 0.0

    @property
    def finished(self) -> bool:
        """The goal is reached."""
        return self._tick >= self._ticks

    @property
    def pose(self) -> Pose:
        """Where it is now."""
        if self.finished:
            return self.goal
        s = self._tick / self._ticks
        share = s**3 * (10.0 - 15.0 * s + 6.0 * s**2)
        position = self.start.position + share * (self.goal.position - self.start.position)
        return Pose(position, slerp(self.start.orientation, self.goal.orientation, np.asarray(share)))

    def advance(self, step: float = 1.0) -> None:
        """Go on by a share of a control period, all of it by default."""
        self._tick += step


def _close(one: Pose, other: Pose) -> bool:
    apart = float(np.linalg.norm(one.position - other.position))
    return apart <= STILL_THERE and angle_between(one.orientation, other.orientation) <= STILL_TURNED


def angle_between(p: Array, q: Array) -> float:
    """The angle between two orientations, unit quaternions of shape (4,) [rad]."""
    return float(np.linalg.norm(log_map(multiply(conjugate(p), q))))
