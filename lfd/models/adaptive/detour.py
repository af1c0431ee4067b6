"""A correction as a detour: how much of it a motion needs that passes elsewhere what the correction led round.

Vectors are relative to start and object; what a correction led round stands where it is. With b the way that the
demonstrations say, b_j that of where the correction was given, and c_j the change that it made,

    r = <b - b_j, c_j> / <c_j, c_j>

says how far a motion goes the way of the correction by itself. It still needs 1 - r of it, from nothing to all. Where r
is less than -1/4 the way round is shorter on the other side: there it needs the mirror image, 1 + r of it, and nothing
where it has as much room as the correction made. For nobody has said how wide the thing is: it is taken to be as wide
to either side of b_j, and the side that the person chose is kept where that leaves three quarters of the room. Once
corrections have led round on either side no side is made up; once one has led to the same side as another from where
the other side would have been nearer, as over a wall, the corrections tell, and nothing of this is assumed.

Where the hand arrives is another matter: that goes with the object. So a change counts as a detour as far as it is
larger than what is left of it at the end, and than one motion differs from another that is meant alike; and only for
motions that lie aside in its own direction. What stands in the way of those that lie across it may be long.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np

from lfd.arrays import Array
from lfd.models.encoding import POSITION


@dataclass(frozen=True, eq=False)
class Needed:
    """What a motion needs of J changes.

    Attributes:
        shares: Of each, from 0 to 1, shape (J,).
        mirrored: Those of which it needs the mirror image, and the unit vector (3,) across the mirror.
    """

    shares: Array
    mirrored: tuple[tuple[int, Array], ...] = ()

    def of(self, changes: Array, weights: Callable[[Array], Array]) -> Array:
        """That of the changes of vectors, shape (J, D); `weights` views those of poses in them, shape (J, N, 6)."""
        kept = self.shares[:, None] * changes
        for j, normal in self.mirrored:
            positions = weights(kept)[j, :, :POSITION]
            positions -= 2.0 * np.outer(positions @ normal, normal)
        return kept


@dataclass(frozen=True, eq=False)
class Detours:
    """What J corrections led round.

    Attributes:
        paths: Where the demonstrations alone led at equal phases, base frame, shape (J, P, 3) [m]; NaN where that is
            not known: all of such a correction is needed everywhere.
        changes: By which the corrections changed that, shape (J, P, 3) [m].
        scatter: By how much motions differ that are meant alike [m], positive.
    """

    paths: Array
    changes: Array
    scatter: float

    @classmethod
    def of(cls, paths: Sequence[Array | None], changes: Array, scatter: float) -> Self:
        """Those of corrections: paths where they are known, else see the class."""
        unknown = np.full(changes.shape[1:], np.nan)
        return cls(np.array([unknown if path is None else path for path in paths]), changes, scatter)

    def needed(self, path: Array, *, shown: bool = False) -> Needed:
        """What is needed of each of them elsewhere.

        Args:
            path: Where the demonstrations alone lead there, shape (P, 3) [m].
            shown: Corrections have led round on either side.
        """
        if self._one_sided:
            return Needed(np.ones(len(self.paths)))
        aside = path - self.paths
        along = np.vecdot(aside, self.changes)
        further = along.sum(axis=1) / self._squares
        lies = np.vecdot(along, along)
        detour = self._detour * _certainly(lies, np.vecdot(self._weights, np.vecdot(aside, aside)) - lies)
        shares = np.where(np.isnan(further), 1.0, 1.0 - detour * further.clip(0.0, 1.0))
        # Between the two sides stands the thing: the side is another one altogether, or it is not.
        other = np.flatnonzero((further < _BETWEEN) & (detour > _RATHER)).tolist() if not shown else []
        shares[other] = (1.0 + further[other]).clip(0.0)
        return Needed(shares, tuple((j, _unit(self._weights[j] @ aside[j])) for j in other))

    @cached_property
    def _one_sided(self) -> bool:
        """Whether a correction led to the same side as another one from where the other side would have been nearer."""
        paths, changes = (x.reshape(len(x), -1) for x in (self.paths, self.changes))
        projected = paths @ changes.T
        further = (projected - projected.diagonal()) / self._squares
        return bool(np.any((further < _BETWEEN) & (self._detour > _RATHER) & (changes @ changes.T > 0.0)))

    @cached_property
    def _weights(self) -> Array:
        """Squares of the changes at each phase, shape (J, P) [m^2]."""
        return np.asarray(np.vecdot(self.changes, self.changes), dtype=np.float64)

    @cached_property
    def _squares(self) -> Array:
        """Their sums, shape (J,) [m^2]."""
        return np.asarray(np.maximum(self._weights.sum(axis=1), _TINY), dtype=np.float64)

    @cached_property
    def _detour(self) -> Array:
        """How far each change is a detour, from 0 to 1, shape (J,)."""
        return _certainly(self._weights.mean(axis=1), self._weights[:, -1] + self.scatter**2)


def _unit(v: Array) -> Array:
    return np.asarray(v / np.sqrt(v @ v), dtype=np.float64)


def _certainly(yes: Array, no: Array) -> Array:
    """How far it is rather the one than the other, from 0 to 1: squares, as between yes and no there is little."""
    return np.asarray(yes**2 / np.maximum(yes**2 + no**2, _TINY), dtype=np.float64)


_BETWEEN = -0.25  # r, from which on the other side is taken
_RATHER = 0.5  # from which on it is rather a detour than not
_TINY = 1e-300
