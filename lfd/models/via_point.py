"""A place that a motion is led through at a time, and how far that moves the rest of it.

Conditioning a Gaussian moves the whole motion by what the via-point says and the covariance carries on. Where the
variance at the via-point's phase is small beside that elsewhere, a small shift there stands for a large one elsewhere:
a motion whose start is given, led aside just after it, would swing by many times as much; and a model of few
demonstrations knows so few ways to move that it does so at any phase. There the prior is widened by a detour: one more
way to move, local, smooth, and as narrow as it must be to leave a given start and earlier via-points where they are.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lfd.arrays import Array, checked, frozen
from lfd.bounds import FRACTION, check_number
from lfd.exceptions import OutOfRange, UnreachableViaPoint
from lfd.models.basis import least_squares
from lfd.models.encoding import OUTPUTS, POSITION, Encoding

SWING = 1.25  # how far a motion may be led away from where it was, in units of the via-point's distance from it [-]
MISSED = 3.0  # by how many of its own standard deviations a via-point may be missed [-]

_REACH = 0.25  # phase: how far a detour leads to both sides where there is room
_SHARES = 10.0 ** np.arange(-3.0, 9.0, 0.5)  # of the detour's variance in all there is, tried in turn
_EXACT = 3e-4  # of the distance of a via-point, within which it is met exactly
_PHASES = np.linspace(0.0, 1.0, 101)


@dataclass(frozen=True, eq=False)
class ViaPoint:
    """A place where the end effector is to be at a time.

    Attributes:
        phase: Time as a fraction of the motion, 0 to 1.
        position: In the base frame, shape (3,) [m].
        covariance: How exactly, shape (3, 3), symmetric and positive semi-definite; zero for exactly [m^2].

    Raises:
        OutOfRange: The phase is not in [0, 1], or the covariance not positive semi-definite.
        WrongShape: An array has the wrong shape.
        NotFinite: A number is NaN or infinite.
    """

    phase: float
    position: Array
    covariance: Array

    def __post_init__(self) -> None:
        check_number("phase of the via-point", self.phase, FRACTION)
        object.__setattr__(self, "position", checked("position", self.position, (3,)))
        covariance = checked("covariance", self.covariance, (3, 3))
        least = float(np.linalg.eigvalsh(0.5 * (covariance + covariance.T)).min())
        if least < -_ROUNDING * max(1.0, float(np.abs(covariance).max())):
            raise OutOfRange("least eigenvalue of the via-point's covariance", least, "zero or more")
        object.__setattr__(self, "covariance", frozen(0.5 * (covariance + covariance.T)))


def position_rows(encoding: Encoding, phase: float) -> Array:
    """The linear map from a vector (D,) of an encoding to the position at a phase from 0 to 1, shape (3, D)."""
    row = encoding.rows(np.array([phase]))[0]
    rows = np.zeros((POSITION, encoding.dimension))
    encoding.weights(rows)[:] = np.kron(row, np.eye(POSITION, OUTPUTS)).reshape(POSITION, -1, OUTPUTS)
    return rows


def gain_of(
    encoding: Encoding, covariance: Array, via: ViaPoint, offset: Array, earlier: Sequence[ViaPoint] = ()
) -> Array:
    """How a vector follows a via-point, shape (D, 3): by `gain @ offset`.

    Args:
        encoding: Of the vectors.
        covariance: Of a vector before, shape (D, D).
        via: That the motion is led through.
        offset: Of its position from the motion's at its phase, shape (3,) [m].
        earlier: Via-points that no detour leads away from.

    Raises:
        UnreachableViaPoint: No detour leads there without swinging the motion.
    """
    rows = position_rows(encoding, via.phase)
    detour = _detour(encoding, via.phase, np.array([one.phase for one in earlier]))
    cross = covariance @ rows.T
    own, away = rows @ cross, float(np.linalg.norm(offset))
    # Exact is what cannot be told from it: rounding, not a wish of the caller's.
    deviation = via.covariance + (_EXACT * away) ** 2 * np.eye(POSITION)
    rounding = _ROUNDING * float(np.trace(covariance))  # where the motion is fixed, that is all that is left
    scale = away**2 + float(np.trace(own + via.covariance))
    least = np.inf
    for variance in [0.0, *(scale * _SHARES)]:
        joint = own + variance * rows @ detour + via.covariance
        gain: Array = (cross + variance * detour) @ _inverse(joint, rounding)
        change = gain @ offset
        missed = offset - rows @ change
        if away > 0.0 and missed @ np.linalg.solve(deviation, missed) > MISSED**2:
            continue
        swing = float(np.linalg.norm(encoding.positions(change[None], len(_PHASES))[0], axis=1).max())
        if swing <= SWING * away:
            return gain
        least = min(least, swing)
    raise UnreachableViaPoint(via.phase, away, least)


def _inverse(joint: Array, rounding: float) -> Array:
    """Of a covariance (3, 3), in the directions in which it is more than rounding; in the others zero."""
    values, vectors = np.linalg.eigh(joint)
    kept = values > rounding
    return np.asarray(vectors[:, kept] / values[kept] @ vectors[:, kept].T, dtype=np.float64)


def _detour(encoding: Encoding, phase: float, kept: Array) -> Array:
    """A smooth bump of each axis about a phase, of height one there, as vectors (D, 3).

    It is zero at the kept phases (k,), and as narrow as that takes; where there is no room for one it is zero.
    """
    N = encoding.basis.count
    fixed = np.append(kept, 0.0) if encoding.anchored else kept
    reach = min([max(_REACH, 2.0 / (N - 1)), *np.abs(fixed - phase)])
    bumps = np.zeros((N, OUTPUTS, POSITION))
    if reach > _ROUNDING:
        near = np.clip((_PHASES - phase) / reach, -1.0, 1.0)
        bump = least_squares(encoding.rows(_PHASES)) @ (0.5 + 0.5 * np.cos(np.pi * near))
        at_kept = encoding.rows(kept)
        bump -= np.linalg.pinv(at_kept) @ (at_kept @ bump)
        height = float(encoding.rows(np.array([phase]))[0] @ bump)
        if height > _ROUNDING:
            bumps[:, :POSITION] = (bump / height)[:, None, None] * np.eye(POSITION)
    return np.pad(bumps.reshape(-1, POSITION), ((0, encoding.dimension - N * OUTPUTS), (0, 0)))


_ROUNDING = 1e-12
