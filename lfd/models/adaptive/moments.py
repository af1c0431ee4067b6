"""Moments of conditions and vectors, from which a part can be taken away without going through the rest again."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from lfd.arrays import Array


@dataclass(frozen=True, eq=False)
class Moments:
    """Count, means and sums of squares of conditions and vectors about their means.

    Attributes:
        count: Of the demonstrations.
        s_mean: Mean condition, shape (c,).
        mean: Mean vector, shape (D,).
        scatter: Of the conditions, shape (c, c).
        cross: Of conditions and vectors, shape (c, D).
    """

    count: int
    s_mean: Array
    mean: Array
    scatter: Array
    cross: Array

    def without(self, S: Array, X: Array) -> Self:
        """The same for what is left when conditions (m, c) and vectors (m, D) are taken away, at least one staying."""
        left = self.count - len(S)
        s_mean = (self.count * self.s_mean - S.sum(axis=0)) / left
        mean = (self.count * self.mean - X.sum(axis=0)) / left
        # Raw sums of the whole less those of the part, moved to the new means.
        raw_scatter = self.scatter + self.count * np.outer(self.s_mean, self.s_mean) - S.T @ S
        raw_cross = self.cross + self.count * np.outer(self.s_mean, self.mean) - S.T @ X
        return type(self)(
            left, s_mean, mean, raw_scatter - left * np.outer(s_mean, s_mean), raw_cross - left * np.outer(s_mean, mean)
        )
