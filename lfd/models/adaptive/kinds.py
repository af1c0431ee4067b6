"""The kinds of output that a vector is made of: each has its own measure, its own surprise and its own reach."""

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from lfd.arrays import Array, frozen
from lfd.models.encoding import OUTPUTS, Encoding
from lfd.models.encoding import POSITION as POSITIONS
from lfd.models.strokes import LEVELS, SHARES, STROKES
from lfd.motion.trajectory import equal_phases

POSITION, ORIENTATION, DURATION, OPENING = range(4)
KINDS = 3  # of every motion; where the gripper takes part its opening is one more

PHASES = 25  # at which motions are compared


@dataclass(frozen=True, eq=False)
class Kinds:
    """How large a vector, or the difference of two, is in each kind.

    The size of positions is their mean square over time [m^2], that of orientations the mean square of the rotation
    vector [rad^2], that of the duration the square of its logarithm, that of openings the squares of their levels and
    the mean squares of their moments, in their units, see `lfd.models.strokes`.

    Attributes:
        rows: The basis at equal phases over the root of their number, shape (P, N): squares of P values add up to a
            mean.
        drawn: The basis at as many equal phases as motions are encoded at, shape (T, N).
        fitted: From values there to weights, shape (N, T).
        grasps: The gripper takes part.
    """

    rows: Array
    drawn: Array
    fitted: Array
    grasps: bool = False

    @classmethod
    def of(cls, encoding: Encoding) -> Self:
        """Those of an encoding's vectors."""
        rows = encoding.rows(equal_phases(PHASES)) / np.sqrt(PHASES)
        phases = equal_phases(encoding.samples)
        return cls(frozen(rows), encoding.rows(phases), encoding.solver(phases), encoding.shown is not None)

    @property
    def count(self) -> int:
        """How many kinds there are, K: 3, or 4 where the gripper takes part."""
        return KINDS + self.grasps

    def filtered(self, X: Array, variances: Array) -> Array:
        """What Wiener's filter keeps of vectors (m, D) among departures of variances (K,): y^3 / (y^2 + v), by value.

        Values are coordinates of positions and rotation vectors at a phase, the duration, and levels and moments of
        openings.
        """
        outputs = self.drawn @ self.weights(X)
        v = np.repeat(variances[:DURATION], [POSITIONS, OUTPUTS - POSITIONS])
        kept = self.fitted @ (outputs * _trusted(outputs, v))
        rest = X[:, self.n_weights :]
        variance = variances[self.of_column[self.n_weights :]]
        return np.concatenate([kept.reshape(len(X), -1), rest * _trusted(rest, variance)], axis=1)

    def details(self, X: Array, variances: Array) -> Array:
        """The rest of them, y v / (y^2 + v), where what is kept is in no kind larger than all of it, shape (m, D)."""
        kept, sizes = self.filtered(X, variances), self.sizes(X)
        most = np.sqrt(sizes / np.maximum(self.sizes(kept), np.maximum(sizes, _TINY)))
        return np.asarray(X - most[self.of_column].T * kept, dtype=np.float64)

    def measured(self, X: Array) -> tuple[Array, ...]:
        """What is compared of vectors (m, D), kind by kind: shapes (m, 3 P), (m, 3 P), (m, 1) and (m, STROKES)."""
        m = len(X)
        outputs = self.rows @ self.weights(X)
        positions, rotations = outputs[..., :POSITIONS], outputs[..., POSITIONS:]
        always = positions.reshape(m, -1), rotations.reshape(m, -1), X[:, -1:]
        return (*always, X[:, self.n_weights : -1] * _OF_STROKES) if self.grasps else always

    def paths(self, X: Array) -> Array:
        """What vectors (m, D) say about positions at the phases at which motions are compared, shape (m, P, 3)."""
        positions = self.measured(X)[POSITION]
        return np.asarray(np.sqrt(PHASES) * positions.reshape(len(X), PHASES, POSITIONS), dtype=np.float64)

    def sizes(self, X: Array) -> Array:
        """Squared sizes of vectors (m, D) in each kind, shape (K, m)."""
        return np.array([np.vecdot(values, values) for values in self.measured(X)])

    def largest(self, X: Array) -> Array:
        """Squared sizes of vectors (m, D), and their largest squares at a phase, in each kind, shape (2, K, m)."""
        outputs = self.rows @ self.weights(X)
        poses = outputs.reshape(len(X), PHASES, DURATION, -1)
        squares = np.vecdot(poses, poses)
        durations = np.broadcast_to(X[:, -1] ** 2, (2, 1, len(X)))
        pointwise = np.array([squares.sum(axis=1).T, PHASES * squares.max(axis=1).T])
        if not self.grasps:
            return np.concatenate([pointwise, durations], axis=1)
        strokes = X[:, self.n_weights : -1]
        each = np.array([np.vecdot(strokes * _OF_STROKES, strokes * _OF_STROKES), (strokes**2).max(axis=1)])
        return np.concatenate([pointwise, durations, each[:, None]], axis=1)

    def bounded(self, x: Array, largest: Array) -> Array:
        """A vector (D,), in each kind no larger than allowed: see `largest`, shape (2, K)."""
        squares = self.largest(x[None])[..., 0]
        if (squares <= largest).all():
            return x
        factors = np.sqrt((largest / np.maximum(squares, np.maximum(largest, _TINY))).min(axis=0))
        return np.asarray(x * factors[self.of_column], dtype=np.float64)

    def products(self, X: Array) -> Array:
        """Inner products of vectors (m, D) with each other in each kind, shape (K, m, m)."""
        return np.array([values @ values.T for values in self.measured(X)])

    def each_from_its_own(self, X: Array) -> Array:
        """The vector (D,) whose entries of each kind come from that kind's row of X, shape (K, D)."""
        return np.asarray(X[self.of_column, self._every_column], dtype=np.float64)

    @cached_property
    def of_column(self) -> NDArray[np.intp]:
        """The kind that each entry of a vector belongs to, shape (D,)."""
        a_function = np.repeat([POSITION, ORIENTATION], [POSITIONS, OUTPUTS - POSITIONS])
        of_strokes = np.full(STROKES if self.grasps else 0, OPENING)
        return np.concatenate([np.tile(a_function, self.rows.shape[1]), of_strokes, [DURATION]])

    @property
    def n_weights(self) -> int:
        """How many entries of a vector are weights of positions and orientations."""
        return int(self.rows.shape[1]) * OUTPUTS

    def weights(self, X: Array) -> Array:
        """Those of vectors (m, D), shape (m, N, 6)."""
        return X[:, : self.n_weights].reshape(len(X), -1, OUTPUTS)

    @cached_property
    def _every_column(self) -> NDArray[np.intp]:
        return np.arange(len(self.of_column))

    @cached_property
    def axis_of_column(self) -> NDArray[np.intp]:
        """The coordinate of the position, 0 to 2, that each entry of a vector belongs to, shape (D,); -1: to none."""
        a_function = np.append(np.arange(POSITIONS), np.full(OUTPUTS - POSITIONS, -1))
        rest = len(self.of_column) - self.n_weights
        return np.append(np.tile(a_function, self.rows.shape[1]), np.full(rest, -1))

    @cached_property
    def columns(self) -> tuple[NDArray[np.intp], ...]:
        """The entries of a vector that belong to each kind."""
        return tuple(np.flatnonzero(self.of_column == kind) for kind in range(self.count))


def _trusted(values: Array, variances: Array) -> Array:
    squares = values**2
    return np.asarray(squares / (squares + variances), dtype=np.float64)


# Of levels and moments, so that squares of moments add up to a mean.
_OF_STROKES = frozen(np.repeat([1.0, SHARES**-0.5], [LEVELS, 2 * SHARES]))
_TINY = 1e-300
