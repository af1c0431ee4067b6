"""How a demonstration becomes a vector of weights, and weights become a trajectory again."""

import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from lfd.arrays import Array, checked_quaternions, frozen
from lfd.bounds import at_least, check_options, check_points
from lfd.models.anchor import Anchor
from lfd.models.basis import GaussianBasis, least_squares
from lfd.motion.demonstration import Demonstration, Situation
from lfd.motion.resampling import poses_at
from lfd.motion.rotations import conjugate, exp_map, left_matrix, log_map, mean_rotation, sign_continuous
from lfd.motion.trajectory import Trajectory, equal_phases


def reference_rotation(demonstrations: Sequence[Demonstration]) -> Array:
    """The mean rotation (4,) of all points of all demonstrations, about which orientations are linearised."""
    return mean_rotation(np.concatenate([d.trajectory.orientations for d in demonstrations]))


OUTPUTS = 6  # x, y, z and the rotation vector
POSITION = 3  # the first outputs

_LONGEST = math.log(sys.float_info.max)  # logarithm of a duration that is a number


@dataclass(frozen=True, eq=False)
class Encoding:
    """Weights of positions relative to the origin, of orientations, and the duration, in one vector.

    What movement primitives call the weight vector w of a trajectory.

    Orientations enter as rotation vectors about one reference rotation (log map), not as the quaternion components
    of the thesis: those lose their unit norm when averaged and mix up q with -q. Durations enter as logarithms, so
    that no prediction is negative.

    Attributes:
        basis: Of all six outputs.
        samples: Number of points at which a trajectory is encoded.
        rotation: The reference rotation, unit quaternion (w, x, y, z).
        anchor: Encode what remains after the start pose is blended out, and put the known start pose back at decoding:
            a prediction then begins exactly where the robot is. None: the weights say where it begins.

    Raises:
        OutOfRange: There are fewer than 2 samples.
        WrongShape: The rotation is no quaternion.
        NotUnitQuaternion: It is not a unit quaternion.
    """

    basis: GaussianBasis
    samples: int
    rotation: Array
    anchor: Anchor | None

    def __post_init__(self) -> None:
        check_options(self, basis=GaussianBasis, samples=at_least(2))
        object.__setattr__(self, "rotation", checked_quaternions("rotation", self.rotation, (4,)))

    def encode(self, demonstration: Demonstration) -> Array:
        """The vector of a demonstration, shape (6 N + 1,): N x 6 weights row by row, then ln(duration / s).

        The weights are the least squares of equation (3), of positions less the origin [m] and rotation vectors [rad].
        """
        phases = equal_phases(self.samples)
        positions, orientations = poses_at(demonstration.trajectory, phases)
        outputs = np.empty((self.samples, OUTPUTS))
        outputs[:, :POSITION] = positions - demonstration.origin  # equation (23)
        outputs[:, POSITION:] = self._rotation_vectors(orientations)
        if self.anchor:
            outputs -= self.anchor.at(outputs[0], phases)
        w = self.solver(phases) @ outputs
        return np.concatenate([w.ravel(), [math.log(demonstration.trajectory.duration)]])

    def decode(self, x: Array, situation: Situation, n: int) -> Trajectory:
        """The trajectory of n points in the base frame that the vector x (6 N + 1,) stands for.

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
        outputs = self.outputs(x, situation, equal_phases(n))
        return Trajectory(
            positions=outputs[:, :POSITION] + situation.origin,
            orientations=exp_map(outputs[:, POSITION:]) @ self._turned,
            duration=math.exp(x[-1]) if x[-1] < _LONGEST else math.inf,
        )

    def positions(self, changes: Array, n: int) -> Array:
        """What changes (J, D) of vectors do to the positions at n equal times, shape (J, n, 3) [m]."""
        weights_of_positions = changes[:, :-1].reshape(len(changes), self.basis.count, OUTPUTS)[:, :, :POSITION]
        return np.asarray(self.rows(equal_phases(n)) @ weights_of_positions, dtype=np.float64)

    def outputs(self, x: Array, situation: Situation, phases: Array) -> Array:
        """Positions relative to the origin [m], base axes, and rotation vectors [rad] at phases (T,), shape (T, 6).

        Args:
            x: As of `encode`.
            situation: See `decode`.
            phases: From 0 to 1.
        """
        outputs = self.rows(phases) @ x[:-1].reshape(self.basis.count, OUTPUTS)
        if self.anchor:
            outputs += self.anchor.at(self.start(situation), phases)
        return outputs

    def output_rates(self, x: Array, situation: Situation, phases: Array) -> Array:
        """Derivatives of `outputs` by the phase, shape (T, 6); see there for the arguments x, situation and phases."""
        rates = self.basis.derivative(phases) @ x[:-1].reshape(self.basis.count, OUTPUTS)
        if self.anchor:
            first = self.basis.matrix(np.zeros(1))[0] @ x[:-1].reshape(self.basis.count, OUTPUTS)
            rates = rates + first + self.anchor.rates(self.start(situation), phases)
        return rates

    def start(self, situation: Situation) -> Array:
        """Of a motion: position relative to the origin [m] and rotation vector [rad], shape (6,)."""
        turned = log_map(situation.start_orientation @ self._turned_back)
        return np.concatenate([situation.start_position - situation.origin, turned])

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
