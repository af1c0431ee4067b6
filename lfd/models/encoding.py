"""How a demonstration becomes a vector of weights, and weights become a trajectory again."""

import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Self

import numpy as np

from lfd.arrays import Array, checked_quaternions, frozen
from lfd.bounds import at_least, check_options, check_points
from lfd.exceptions import OpeningMismatch
from lfd.models.anchor import Anchor
from lfd.models.basis import GaussianBasis, least_squares
from lfd.models.strokes import STROKES, opening_of, strokes_of
from lfd.motion.demonstration import Demonstration, Situation
from lfd.motion.resampling import poses_at
from lfd.motion.rotations import conjugate, exp_map, left_matrix, log_map, mean_rotation, sign_continuous
from lfd.motion.trajectory import Trajectory, equal_phases


def reference_rotation(demonstrations: Sequence[Demonstration]) -> Array:
    """The mean rotation (4,) of all points of all demonstrations, about which orientations are linearised."""
    return mean_rotation(np.concatenate([d.trajectory.orientations for d in demonstrations]))


def shown_in(demonstrations: Sequence[Demonstration]) -> tuple[float, float] | None:
    """The least and the greatest opening in demonstrations, at least one [m]; None where the gripper takes no part.

    Raises:
        OpeningMismatch: It takes part in some of them only.
    """
    openings = [d.trajectory.opening for d in demonstrations if d.trajectory.opening is not None]
    if not openings:
        return None
    if len(openings) < len(demonstrations):
        raise OpeningMismatch
    return min(float(one.min()) for one in openings), max(float(one.max()) for one in openings)


OUTPUTS = 6  # x, y, z and the rotation vector
POSITION = 3  # the first outputs

_LONGEST = math.log(sys.float_info.max)  # logarithm of a duration that is a number


@dataclass(frozen=True, eq=False)
class Encoding:
    """Weights of positions relative to the origin and of orientations, the gripper's strokes, and the duration.

    One vector: what movement primitives call the weight vector w of a trajectory.

    Orientations enter as rotation vectors about one reference rotation (log map), not as the quaternion components
    of the thesis: those lose their unit norm when averaged and mix up q with -q. Durations enter as logarithms, so
    that no prediction is negative. Where the gripper takes part, its opening enters by how much it opens and closes and
    when, see `lfd.models.strokes`.

    Attributes:
        basis: Of all six outputs.
        samples: Number of points at which a trajectory is encoded.
        rotation: The reference rotation, unit quaternion (w, x, y, z).
        anchor: Encode what remains after the start pose is blended out, and put the known start pose back at decoding:
            a prediction then begins exactly where the robot is. None: the weights say where it begins.
        shown: The least and the greatest opening that was shown [m], beyond which none is predicted; None where the
            gripper takes no part.

    Raises:
        OutOfRange: There are fewer than 2 samples.
        WrongShape: The rotation is no quaternion.
        NotUnitQuaternion: It is not a unit quaternion.
    """

    basis: GaussianBasis
    samples: int
    rotation: Array
    anchor: Anchor | None
    shown: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        check_options(self, basis=GaussianBasis, samples=at_least(2))
        object.__setattr__(self, "rotation", checked_quaternions("rotation", self.rotation, (4,)))

    def encode(self, demonstration: Demonstration) -> Array:
        """The vector of a demonstration, shape (D,): N x 6 weights row by row, strokes if any, then ln(duration / s).

        The weights are the least squares of equation (3), of positions less the origin [m] and rotation vectors [rad].

        Raises:
            OpeningMismatch: The gripper takes part in it and not here, or here and not in it.
        """
        trajectory = demonstration.trajectory
        if (trajectory.opening is None) is not (self.shown is None):
            raise OpeningMismatch
        phases = equal_phases(self.samples)
        positions, orientations = poses_at(trajectory, phases)
        outputs = np.empty((self.samples, OUTPUTS))
        outputs[:, :POSITION] = positions - demonstration.origin  # equation (23)
        outputs[:, POSITION:] = self._rotation_vectors(orientations)
        if self.anchor:
            outputs -= self.anchor.at(outputs[0], phases)
        w = self.solver(phases) @ outputs
        grasp = [] if trajectory.opening is None else [strokes_of(trajectory.opening, trajectory.phases)]
        return np.concatenate([w.ravel(), *grasp, [math.log(trajectory.duration)]])

    def including(self, openings: tuple[float, float] | None) -> Self:
        """The encoding when openings from a least to a greatest [m] were shown too."""
        if self.shown is None or openings is None:
            return self
        return replace(self, shown=(min(self.shown[0], openings[0]), max(self.shown[1], openings[1])))

    def decode(self, x: Array, situation: Situation, n: int) -> Trajectory:
        """The trajectory of n points in the base frame that the vector x (D,) stands for.

        Args:
            x: As of `encode`.
            situation: Whose origin the motion is relative to, and whose start pose it begins at, if anchored.
            n: Number of points.

        Raises:
            TooFewPoints: n is less than 2.
            NotFinite: The vector stands for no motion: its duration is beyond all numbers.
            InvalidDuration: Or it is none.
        """
        check_points("decoded motion", n)
        phases = equal_phases(n)
        outputs = self.outputs(x, situation, phases)
        return Trajectory(
            positions=outputs[:, :POSITION] + situation.origin,
            orientations=exp_map(outputs[:, POSITION:]) @ self._turned,
            duration=math.exp(x[-1]) if x[-1] < _LONGEST else math.inf,
            opening=None if self.shown is None else opening_of(self.strokes(x), phases, *self.shown),
        )

    def positions(self, changes: Array, n: int) -> Array:
        """What changes (J, D) of vectors do to the positions at n equal times, shape (J, n, 3) [m]."""
        weights_of_positions = self.weights(changes)[:, :, :POSITION]
        return np.asarray(self.rows(equal_phases(n)) @ weights_of_positions, dtype=np.float64)

    def outputs(self, x: Array, situation: Situation, phases: Array) -> Array:
        """Positions relative to the origin [m], base axes, and rotation vectors [rad] at phases (T,), shape (T, 6).

        Args:
            x: As of `encode`.
            situation: See `decode`.
            phases: From 0 to 1.
        """
        outputs = self.rows(phases) @ self.weights(x)
        if self.anchor:
            outputs += self.anchor.at(self.start(situation), phases)
        return outputs

    def output_rates(self, x: Array, situation: Situation, phases: Array) -> Array:
        """Derivatives of `outputs` by the phase, shape (T, 6); see there for the arguments x, situation and phases."""
        rates = self.basis.derivative(phases) @ self.weights(x)
        if self.anchor:
            first = self.basis.matrix(np.zeros(1))[0] @ self.weights(x)
            rates = rates + first + self.anchor.rates(self.start(situation), phases)
        return rates

    def start(self, situation: Situation) -> Array:
        """Of a motion: position relative to the origin [m] and rotation vector [rad], shape (6,)."""
        turned = log_map(situation.start_orientation @ self._turned_back)
        return np.concatenate([situation.start_position - situation.origin, turned])

    @property
    def dimension(self) -> int:
        """Of a vector: D."""
        return self.basis.count * OUTPUTS + (0 if self.shown is None else STROKES) + 1

    def weights(self, x: Array) -> Array:
        """Those of positions and orientations in vectors (..., D), shape (..., N, 6); a view where x allows one."""
        return x[..., : self.basis.count * OUTPUTS].reshape(*x.shape[:-1], self.basis.count, OUTPUTS)

    def strokes(self, x: Array) -> Array:
        """What the gripper does in vectors (..., D), shape (..., STROKES); it takes part."""
        return x[..., self.basis.count * OUTPUTS : -1]

    @property
    def anchored(self) -> bool:
        """A motion begins at the start pose whatever its weights."""
        return self.anchor is not None

    def rows(self, phases: Array) -> Array:
        """The basis at phases (T,), shape (T, N); if anchored, with the value at phase 0 blended out to zero."""
        return _rows(self.basis, phases.tobytes(), self.anchored)

    def solver(self, phases: Array) -> Array:
        """From what outputs are at phases (T,) to the weights that come nearest to it, shape (N, T): equation (3)."""
        return _solver(self.basis, phases.tobytes(), self.anchored)

    def _rotation_vectors(self, orientations: Array) -> Array:
        relative = orientations @ self._turned_back
        first = -1.0 if relative[0, 0] < 0.0 else 1.0
        return log_map(sign_continuous(first * relative), shortest=False)

    @cached_property
    def _turned(self) -> Array:
        return left_matrix(self.rotation)

    @cached_property
    def _turned_back(self) -> Array:
        return left_matrix(conjugate(self.rotation))


# Both are kept, read-only: they are the same for all motions of one number of points. Phases go by their bytes, as an
# array has no hash.


@lru_cache(maxsize=16)
def _rows(basis: GaussianBasis, phases: bytes, anchored: bool) -> Array:
    t = np.frombuffer(phases)
    Phi = basis.matrix(t)
    return frozen(Phi - np.outer(1.0 - t, basis.matrix(np.zeros(1))[0]) if anchored else Phi)


@lru_cache(maxsize=16)
def _solver(basis: GaussianBasis, phases: bytes, anchored: bool) -> Array:
    """From the outputs at the phases (T, d) to the weights (N, d)."""
    return frozen(least_squares(_rows(basis, phases, anchored)))
