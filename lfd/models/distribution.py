"""A distribution over motions: sampled, differentiated, led through via-points, blended with another.

The operations of probabilistic movement primitives (Paraschos et al., "Using probabilistic movement primitives in
robotics", Autonomous Robots 42, 2018), for whatever model the distribution comes from.
"""

from dataclasses import dataclass, replace

import numpy as np

from lfd.arrays import Array, checked, frozen
from lfd.bounds import NOT_NEGATIVE, at_least, check_number, check_options, check_points
from lfd.exceptions import OutOfRange
from lfd.models.encoding import OUTPUTS, POSITION, Encoding
from lfd.models.via_point import ViaPoint, gain_of, position_rows
from lfd.motion.demonstration import Situation
from lfd.motion.opening import openings
from lfd.motion.rotations import rotate, slerp
from lfd.motion.trajectory import Trajectory, equal_phases


@dataclass(frozen=True, eq=False)
class MotionDistribution:
    """A Gaussian over the weights of a motion in one situation: a probabilistic movement primitive, conditioned.

    Attributes:
        encoding: Between weights and motions.
        situation: That the motion starts in.
        mean: As `Encoding.encode` gives it, shape (D,).
        covariance: Of it, shape (D, D).
        noise_std: Of each position about the weights' motion (sigma of equation (13)) [m].
        via_points: That it was led through.

    Raises:
        OutOfRange: `noise_std` is negative.
    """

    encoding: Encoding
    situation: Situation
    mean: Array
    covariance: Array
    noise_std: float = 0.0
    via_points: tuple[ViaPoint, ...] = ()

    def __post_init__(self) -> None:
        check_options(self, noise_std=NOT_NEGATIVE)

    def trajectory(self, n: int) -> Trajectory:
        """The mean motion, n points at equal times in the base frame.

        Raises:
            TooFewPoints: n is less than 2.
        """
        return self.encoding.decode(self.mean, self.situation, n)

    def position_covariances(self, n: int) -> Array:
        """Of the positions at n equal times in the base frame, shape (n, 3, 3) [m^2]: equation (13)."""
        covariances = position_covariances(self.encoding, self.covariance, n)
        return covariances + self.noise_std**2 * np.eye(POSITION)

    @property
    def duration_std(self) -> float:
        """Standard deviation of the duration, to first order [s]."""
        return float(np.exp(self.mean[-1]) * np.sqrt(max(self.covariance[-1, -1], 0.0)))

    def velocities(self, n: int) -> tuple[Array, Array]:
        """Linear [m/s] and angular [rad/s] velocities of the mean motion at n equal times, base frame, each (n, 3).

        Raises:
            TooFewPoints: n is less than 2.
        """
        check_points("motion", n)
        phases, duration = equal_phases(n), float(np.exp(self.mean[-1]))
        outputs = self.encoding.outputs(self.mean, self.situation, phases)
        rates = self.encoding.output_rates(self.mean, self.situation, phases) / duration
        turning = _angular_velocity(outputs[:, POSITION:], rates[:, POSITION:])
        return rates[:, :POSITION], rotate(self.encoding.rotation, turning)

    def sample(self, rng: np.random.Generator, count: int, n: int) -> list[Trajectory]:
        """Motions drawn from the distribution, without the noise of single points.

        Args:
            rng: Where chance comes from.
            count: Number of motions.
            n: Points of each.

        Raises:
            OutOfRange: The number of motions is negative.
            TooFewPoints: n is less than 2.
        """
        check_number("number of samples", count, at_least(0))
        check_points("motion", n)
        values, vectors = np.linalg.eigh(self.covariance)
        spread = vectors * np.sqrt(np.maximum(values, 0.0))
        draws = self.mean + rng.standard_normal((count, len(values))) @ spread.T
        return [self.encoding.decode(x, self.situation, n) for x in draws]

    def through(self, via: ViaPoint) -> "MotionDistribution":
        """The distribution given that the motion passes a via-point: conditioning (Paraschos et al. 2018, eq. 15, 16).

        Those equations are kept to where they lead the motion no further away, anywhere, than `SWING` times as far as
        the via-point lies off it, and to within `MISSED` of the via-point's own deviations. Elsewhere a local detour is
        allowed for, as much as that takes, which leaves earlier via-points alone; see `lfd.models.via_point`.

        Args:
            via: Position in the base frame, phase and covariance.

        Raises:
            UnreachableViaPoint: It lies off the motion so near to a start that is given, or to an earlier via-point,
                that no detour leads there.
        """
        at = self.encoding.outputs(self.mean, self.situation, np.array([via.phase]))[0, :POSITION]
        offset = via.position - self.situation.origin - at
        rows = position_rows(self.encoding, via.phase)
        gain = gain_of(self.encoding, self.covariance, via, offset, self.via_points)
        # (I - G R) Sigma (I - G R)^T + G S G^T, which holds for any gain G: multiplied out, of second order in D.
        carried = self.covariance @ rows.T @ gain.T
        covariance = self.covariance - carried - carried.T + gain @ (rows @ carried + via.covariance @ gain.T)
        mean, led = frozen(self.mean + gain @ offset), (*self.via_points, via)
        return replace(self, mean=mean, covariance=frozen(covariance), via_points=led)


def position_covariances(encoding: Encoding, covariance: Array, n: int) -> Array:
    """Phi Sigma_w Phi^T of the positions at n equal times, shape (n, 3, 3) [m^2].

    Args:
        encoding: Of the vectors.
        covariance: Of a vector, shape (D, D).
        n: Number of points.

    Raises:
        TooFewPoints: n is less than 2.
    """
    check_points("motion", n)
    N = encoding.basis.count
    Phi = encoding.rows(equal_phases(n))
    of_weights = covariance[: N * OUTPUTS, : N * OUTPUTS]
    Sigma = of_weights.reshape(N, OUTPUTS, N, OUTPUTS)[:, :POSITION, :, :POSITION]
    half = np.tensordot(Phi, Sigma, axes=1)  # (n, 3, N, 3)
    return np.asarray(np.einsum("tibj,tb->tij", half, Phi), dtype=np.float64)


def blend(first: MotionDistribution, second: MotionDistribution, shares: Array) -> tuple[Trajectory, Array]:
    """Two motions as one that goes over from the first to the second (Paraschos et al. 2018, eq. 21 to 23).

    At each time the product of both Gaussians, each to the power of its activation: the surer one counts more.
    Orientations and the duration go over by the activation alone, openings at once where it passes a half.

    Args:
        first: Where the share is 0.
        second: Where it is 1.
        shares: Activation of the second at n equal times, 0 to 1, shape (n,), n at least 2.

    Returns:
        The motion and the covariances of its positions, shape (n, 3, 3) [m^2].

    Raises:
        OutOfRange: A share is not in [0, 1].
        TooFewPoints: There are fewer than two shares.
        WrongShape: The shares are no vector.
        OpeningMismatch: The gripper takes part in one of the two only.
    """
    activation = checked("shares", shares, (None,))
    n = len(activation)
    check_points("blend", n)
    if activation.min() < 0.0 or activation.max() > 1.0:
        wrong = activation.min() if activation.min() < 0.0 else activation.max()
        raise OutOfRange("share", float(wrong), "from 0 to 1")
    a, b = first.trajectory(n), second.trajectory(n)
    grasps = openings(a, b)
    weights = [(1.0 - activation)[:, None, None], activation[:, None, None]]
    information = np.zeros((n, POSITION, POSITION))
    state = np.zeros((n, POSITION))
    for share, motion, distribution in zip(weights, (a, b), (first, second), strict=True):
        own = distribution.position_covariances(n)
        least = _ROUNDING * (1.0 + np.trace(own, axis1=1, axis2=2))[:, None, None]
        inverse = share * np.linalg.inv(own + least * np.eye(POSITION))
        information += inverse
        state += np.einsum("tij,tj->ti", inverse, motion.positions)
    covariances = np.asarray(np.linalg.inv(information), dtype=np.float64)
    trajectory = Trajectory(
        positions=np.einsum("tij,tj->ti", covariances, state),
        orientations=slerp(a.orientations, b.orientations, activation),
        duration=float(np.exp(np.mean(np.log(a.duration) + activation * np.log(b.duration / a.duration)))),
        opening=None if grasps is None else np.where(activation < _HALF, *grasps),
    )
    return trajectory, covariances


def _angular_velocity(r: Array, rate: Array) -> Array:
    """Of exp(r) turning at dr/dt, in the axes that r is in: the left Jacobian of SO(3) times the rate, (n, 3) each.

    Sola et al., "A micro Lie theory for state estimation in robotics", 2018, eq. 145.
    """
    angle = np.linalg.norm(r, axis=1, keepdims=True)
    safe = np.maximum(angle, 1e-4)
    small = angle < 1e-4
    first = np.where(small, 0.5 - angle**2 / 24.0, (1.0 - np.cos(safe)) / safe**2)
    second = np.where(small, 1.0 / 6.0 - angle**2 / 120.0, (safe - np.sin(safe)) / safe**3)
    once = np.cross(r, rate)
    return np.asarray(rate + first * once + second * np.cross(r, once), dtype=np.float64)


_HALF = 0.5
_ROUNDING = 1e-12
