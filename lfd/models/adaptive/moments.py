"""Moments of conditions and vectors, and what is left of them without a part."""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from lfd.arrays import Array


@dataclass(frozen=True, eq=False)
class Moments:
    """Count, means and sums of products of conditions and vectors about their means, of one set or of many.

    Attributes:
        count: Of the demonstrations, shape (...,).
        s_mean: Mean condition, shape (..., c).
        mean: Mean vector, shape (..., D).
        scatter: Of the conditions, shape (..., c, c).
        cross: Of conditions and vectors, shape (..., c, D).
    """

    count: Array
    s_mean: Array
    mean: Array
    scatter: Array
    cross: Array

    @classmethod
    def of(cls, S: Array, X: Array) -> Self:
        """Those of conditions (M, c) and vectors (M, D), at least one."""
        s_mean, mean = S.mean(axis=0), X.mean(axis=0)
        away = S - s_mean
        return cls(np.array(float(len(S))), s_mean, mean, away.T @ away, away.T @ (X - mean))

    def part(self, dimensions: NDArray[np.intp], columns: NDArray[np.intp]) -> Self:
        """Those of some dimensions of the conditions, and of some entries of the vectors."""
        rows = dimensions[:, None]
        return replace(
            self,
            s_mean=self.s_mean[..., dimensions],
            mean=self.mean[..., columns],
            scatter=self.scatter[..., rows, dimensions],
            cross=self.cross[..., rows, columns],
        )

    @classmethod
    def without_each(cls, S: Array, X: Array, owner: NDArray[np.intp]) -> Self:
        """Those of what is left without each group in turn, shapes with a leading axis of the groups.

        Args:
            S: Conditions, shape (M, c).
            X: Vectors, shape (M, D).
            owner: The group of each, from 0, shape (M,); each group leaves something.
        """
        order = np.argsort(owner, kind="stable")
        first = np.flatnonzero(np.diff(owner[order], prepend=-1))
        # About the means of all, so that sums of products lose no digits.
        whole = cls.of(S, X)
        s, x = (S - whole.s_mean)[order], (X - whole.mean)[order]
        left = len(S) - np.diff(first, append=len(S)).astype(np.float64)
        s_mean, mean = (-np.add.reduceat(values, first) / left[:, None] for values in (s, x))
        squares = np.add.reduceat(s[:, :, None] * s[:, None], first)
        products = np.add.reduceat(s[:, :, None] * x[:, None], first)
        about = left[:, None, None] * s_mean[:, :, None]
        return cls(
            left,
            whole.s_mean + s_mean,
            whole.mean + mean,
            whole.scatter - squares - about * s_mean[:, None],
            whole.cross - products - about * mean[:, None],
        )
