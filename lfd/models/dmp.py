"""Dynamic movement primitives, the thesis' comparator (appendix B): one demonstration, towards a goal that is given.

Per axis, with the time s = t / T in fractions of the duration (so that the path is the same at any duration):

    y'' = alpha_y (beta_y (g - y) - y') + f(x)                  (B.9), from rest, with beta_y = alpha_y / 4
    x'  = -alpha_x x                                            (B.10), so x = exp(-alpha_x s)
    f   = x sum_i psi_i w_i / sum_i psi_i                       (B.11)
    psi_i = exp(-h_i (x - c_i)^2)                               (B.12), c_i at even times, h_i = 1 / (c_i - c_{i+1})^2

The system is linear and its forcing f depends on nothing but the time, so nothing is integrated in steps: the response
to each psi_i is an integral, and a reproduction a sum of responses.

What the text leaves open or what does not work as it stands:

1. Equation (B.11) multiplies f by g - y0. That is singular for a demonstration that ends where it started on an axis,
   and multiplies the shape by large numbers for one that nearly does. Here f is not scaled, as it is not in the package
   that the thesis used (after Pastor et al., 2009). `Scaling.PER_AXIS` is (B.11) to the letter, for positions, and
   refuses such a demonstration. Recorded reaching motions, each reproduced from the one of the nearest other condition
   with its own goal given, are missed by 0.062 m without and, where nothing is refused, 0.168 m with the scaling (root
   mean square). That package also adds -alpha_y beta_y (g - y0) x, for a softer start; it is left out, because the
   motion then ends 2.5 % of a shift of the goal away from it.
2. Equations (B.13) to (B.17) fit f to accelerations, which a recording has to be differentiated twice for. Here both
   sides pass through the attractor first: the w are the least squares of positions, in metres, over all psi_i at once.
   Locally weighted regression fits each w_i by itself, as if the psi_i did not overlap; on the same motions it leaves
   1.8 mm (median) of second differences where this leaves 0.08 mm. The goal counts as `GOAL_WEIGHT` points, so that
   the motion ends there.
3. The orientation of the thesis is one more y. Here y is the rotation vector of the rotation from the goal to the
   present orientation, in base axes (Ude et al., 2014), and (B.9) holds for that vector itself, not for an angular
   velocity in its place (Koutras and Doulgeri, 2020): it stays linear, and its goal is zero.
"""

import math
from dataclasses import dataclass
from enum import Enum
from typing import Self

import numpy as np

from lfd.arrays import Array, checked, checked_quaternions, frozen
from lfd.bounds import Bounds, at_least, check_options, check_points
from lfd.exceptions import OutOfRange
from lfd.motion.resampling import Interpolation, resample
from lfd.motion.rotations import conjugate, exp_map, log_map, multiply
from lfd.motion.trajectory import PREDICTION_POINTS, Trajectory, equal_phases

GOAL_WEIGHT = 1e6
LEAST_EXTENT = 1e-3  # [m] between start and goal on an axis, to scale by it

_NODES, _NODE_WEIGHTS = np.polynomial.legendre.leggauss(3)


class Scaling(Enum):
    """How the shape of a position's path follows its start and goal."""

    NONE = "none"  # it does not: start and goal moved together move the path
    PER_AXIS = "per axis"  # equation (B.11): an axis is stretched as the distance from start to goal is


@dataclass(frozen=True)
class DmpOptions:
    """Parameters.

    Attributes:
        count: N, the number of basis functions. Recorded motions of a hand need about a hundred for a millimetre.
        alpha_y: Of the attractor. What a new start or goal adds has faded to (1 + a) exp(-a) of it at the end, with
            a = alpha_y / 2: to 5e-5.
        alpha_x: Of the canonical system; x ends at 0.01.
        scaling: Of the path's shape.

    Raises:
        OutOfRange: A parameter makes no motion, or one that overflows.
    """

    count: int = 100
    alpha_y: float = 25.0
    alpha_x: float = math.log(100.0)
    scaling: Scaling = Scaling.NONE

    def __post_init__(self) -> None:
        check_options(
            self,
            count=at_least(2),
            alpha_y=Bounds(0.0, 1000.0, above=True),
            alpha_x=Bounds(0.0, 20.0, above=True),
            scaling=Scaling,
        )


@dataclass(frozen=True, eq=False)
class DMP:
    """A motion of the end effector that can be led to another goal, see the module.

    Attributes:
        weights: w of the positions and rotation vectors, shape (N, 6).
        displacement: y0 - g of the demonstration: positions [m], then rotation vector [rad], shape (6,).
        options: Parameters.
        opening: Of the demonstration's gripper at its points, which a reproduction repeats at the same phases: it is
            led by no spring; shape (n,) [m]. None where the gripper takes no part.
    """

    weights: Array
    displacement: Array
    options: DmpOptions
    opening: Array | None = None

    @classmethod
    def fit(cls, trajectory: Trajectory, options: DmpOptions | None = None) -> Self:
        """The primitive of one demonstration.

        Args:
            trajectory: In any frame; its last pose is the goal.
            options: Parameters.

        Raises:
            OutOfRange: The orientation is a full turn or more away from the last one, or the positions are to be
                scaled along an axis on which the demonstration ends where it started.
        """
        options = options or DmpOptions()
        # Between few points the functions would be free to swing.
        few = trajectory.n_points < 2 * options.count
        points = resample(trajectory, 2 * options.count, Interpolation.CUBIC) if few else trajectory
        goal = points.orientations[-1]
        y = np.hstack([points.positions - points.positions[-1], _rotations_to(goal, points.orientations)])
        if options.scaling is Scaling.PER_AXIS:
            _check_extents(y[0, :3])
        f = y - np.outer(_decay(options, points.phases), y[0])
        importance = np.ones((points.n_points, 1))
        importance[-1] = math.sqrt(GOAL_WEIGHT)
        X = _response(options, np.eye(options.count), points.n_points)
        w, *_ = np.linalg.lstsq(importance * X, importance * f, rcond=None)
        return cls(frozen(w), frozen(y[0]), options, trajectory.opening)

    def reproduce(
        self,
        start_pose: tuple[Array, Array],
        goal_pose: tuple[Array, Array],
        duration: float,
        n: int = PREDICTION_POINTS,
    ) -> Trajectory:
        """The motion from a start pose to a goal pose, both in the demonstration's frame.

        It begins exactly at the start, and ends as near to the goal as `DmpOptions.alpha_y` says. It turns the way
        round that the demonstration did.

        Args:
            start_pose: Position (3,) [m] and orientation (4,), a unit quaternion (w, x, y, z).
            goal_pose: The same at the end.
            duration: Of the motion [s].
            n: Number of points, at least 2.

        Raises:
            TooFewPoints: n is less than 2.
            WrongShape: An array has the wrong shape.
            NotFinite: A number is NaN or infinite.
            NotUnitQuaternion: An orientation is not a unit quaternion.
            InvalidDuration: The duration is not positive.
        """
        check_points("reproduction", n)
        y0, q0 = _checked_pose("start", start_pose)
        g, q_g = _checked_pose("goal", goal_pose)
        turn = _nearest(log_map(multiply(q0, conjugate(q_g))), self.displacement[3:])
        displacement = np.concatenate([y0 - g, turn])
        y = np.outer(_decay(self.options, np.linspace(0.0, 1.0, n)), displacement)
        y += _response(self.options, self.weights * self._scale(displacement), n)
        shown, phases = self.opening, equal_phases(n)
        opening = None if shown is None else np.interp(phases, equal_phases(len(shown)), shown)
        return Trajectory(g + y[:, :3], multiply(exp_map(y[:, 3:]), q_g), duration, opening)

    def _scale(self, displacement: Array) -> Array:
        """The factor on the forcing of each axis, shape (6,); rotations are never scaled."""
        scale = np.ones(6)
        if self.options.scaling is Scaling.PER_AXIS:
            scale[:3] = displacement[:3] / self.displacement[:3]
        return scale


def _decay(options: DmpOptions, s: Array) -> Array:
    """What is left at s (n,) of y0 - g without forcing: the critically damped answer of (B.9) from rest."""
    a = options.alpha_y / 2.0
    left: Array = (1.0 + a * s) * np.exp(-a * s)
    return left


def _response(options: DmpOptions, weights: Array, n: int) -> Array:
    """The y of (B.9) at n even times from 0 to 1 for weights (N, d), start and goal being zero; shape (n, d).

    That is the integral from 0 to s of (s - u) exp(-a (s - u)) f(u) du, with a = alpha_y / 2, by three-point
    Gauss-Legendre quadrature over pieces at most half as long as the functions are apart.
    """
    a = options.alpha_y / 2.0
    pieces = math.ceil(2 * options.count / (n - 1))
    edges = np.linspace(0.0, 1.0, (n - 1) * pieces + 1)
    half = 0.5 * edges[1]
    u = (edges[:-1, None] + half * (1.0 + _NODES)).ravel()
    share = np.tile(half * _NODE_WEIGHTS, len(edges) - 1) * np.exp(a * u)
    f = share[:, None] * _forcing(options, weights, u)
    nodes = (n - 1, pieces * len(_NODES), weights.shape[1])
    A = np.cumsum(f.reshape(nodes).sum(axis=1), axis=0)
    B = np.cumsum((u[:, None] * f).reshape(nodes).sum(axis=1), axis=0)
    s = np.linspace(0.0, 1.0, n)[1:, None]
    return np.vstack([np.zeros((1, weights.shape[1])), np.exp(-a * s) * (s * A - B)])


def _forcing(options: DmpOptions, weights: Array, s: Array) -> Array:
    """The f of (B.11) and (B.12) at times s (m,) for weights (N, d), shape (m, d)."""
    x = np.exp(-options.alpha_x * s)
    c = np.exp(-options.alpha_x * np.linspace(0.0, 1.0, options.count))
    gaps = -np.diff(c)
    h = 1.0 / np.append(gaps, gaps[-1]) ** 2
    psi = np.exp(-h * (x[:, None] - c) ** 2)
    f: Array = (x / psi.sum(axis=1))[:, None] * (psi @ weights)
    return f


def _rotations_to(goal: Array, orientations: Array) -> Array:
    """Rotation vectors, shape (n, 3) [rad], in base axes from the goal to sign-continuous orientations that end there.

    Raises:
        OutOfRange: The vectors jump, as they do a full turn away from the goal.
    """
    r = log_map(multiply(orientations, conjugate(goal)), shortest=False)
    jump = np.linalg.norm(np.diff(r, axis=0), axis=1) > np.pi
    if jump.any():
        angle = float(np.linalg.norm(r, axis=1)[:-1][jump].max())
        raise OutOfRange("angle [rad] from the demonstration's last orientation", angle, "less than a full turn")
    return r


def _nearest(r: Array, to: Array) -> Array:
    """Of the two rotation vectors (3,) that are the rotation of r, the nearer one to another vector."""
    angle = np.linalg.norm(r)
    if angle == 0.0:
        return r
    other = r * (1.0 - 2.0 * np.pi / angle)
    return other if np.linalg.norm(other - to) < np.linalg.norm(r - to) else r


def _checked_pose(name: str, pose: tuple[Array, Array]) -> tuple[Array, Array]:
    """Position and orientation, the latter in the sign with w >= 0."""
    position, orientation = pose
    q = checked_quaternions(f"{name} orientation", orientation, (4,))
    return checked(f"{name} position", position, (3,)), -q if q[0] < 0.0 else q


def _check_extents(displacement: Array) -> None:
    for axis, distance in zip("xyz", np.abs(displacement), strict=True):
        if distance < LEAST_EXTENT:
            allowed = f"at least {LEAST_EXTENT:g} m to scale by it; Scaling.NONE always can"
            raise OutOfRange(f"distance from the demonstration's start to its goal along {axis}", distance, allowed)
