"""Linear trends of vectors over a condition, from one that is believed to none at all."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lfd.arrays import Array
from lfd.bounds import NOT_NEGATIVE, POSITIVE, check_number, check_options
from lfd.exceptions import OutOfRange
from lfd.models.adaptive.moments import Moments


@dataclass(frozen=True)
class TrendOptions:
    """Of ridge regressions; lengths are in units of `ConditionScale`.

    Attributes:
        shrinkages: Ridge of each trend [thirds of the scatter of the conditions], ascending from 0; infinite is none.
        least: Directions in which the standard deviation of the conditions is less teach no trend: it may be noise.
        marker_noise: Differences of the condition below this teach little, as far as a trend is shrunk.
        softness: How far beyond the conditions seen a trend leads on, as a fraction of their own radius.

    Raises:
        OutOfRange: One is not what it can be.
    """

    shrinkages: tuple[float, ...] = (0.0, 0.15, 0.5, 1.5, np.inf)
    least: float = 0.04
    marker_noise: float = 0.1
    softness: float = 0.5

    def __post_init__(self) -> None:
        check_options(self, least=NOT_NEGATIVE, marker_noise=NOT_NEGATIVE, softness=POSITIVE)
        *trusted, none = self.shrinkages or (0.0,)
        for shrinkage in trusted:
            check_number("TrendOptions.shrinkages", shrinkage, NOT_NEGATIVE)
        if trusted[:1] != [0.0] or none != np.inf or sorted(set(trusted)) != trusted:
            raise OutOfRange("TrendOptions.shrinkages", self.shrinkages, "ascending from 0 to infinity")


def slopes(moments: Moments, options: TrendOptions) -> Array:
    """A ridge regression with each shrinkage, shape (..., K, c, D)."""
    axes, values, differs = directions(moments, options)
    ridges = np.array(options.shrinkages[:-1]) * _ridge(values * differs, moments.count, options)[..., None]
    kept = differs[..., None, :] / (np.where(differs, values, 1.0)[..., None, :] + ridges[..., None])
    along = np.swapaxes(axes, -1, -2) @ moments.cross
    sloped = axes[..., None, :, :] @ (kept[..., None] * along[..., None, :, :])
    return np.concatenate([sloped, np.zeros_like(sloped[..., :1, :, :])], axis=-3)


def slopes_by_coordinate(moments: Moments, depends: NDArray[np.bool_], options: TrendOptions) -> Array:
    """The same, where an entry of the vectors depends on some dimensions of the condition only.

    Args:
        moments: Of conditions and vectors.
        depends: Which entries may depend on which dimensions, shape (c, D).
        options: Of the trends.

    Returns:
        Shape (..., K, c, D); zero where nothing depends.
    """
    cross = moments.cross
    sloped = np.zeros((*cross.shape[:-2], len(options.shrinkages), *depends.shape))
    patterns, pattern_of = np.unique(depends, axis=1, return_inverse=True)
    for p, pattern in enumerate(patterns.T):
        dimensions, columns = np.flatnonzero(pattern), np.flatnonzero(pattern_of == p)
        if len(dimensions):
            sloped[..., dimensions[:, None], columns] = slopes(moments.part(dimensions, columns), options)
    return sloped


def directions(moments: Moments, options: TrendOptions) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Principal directions of the conditions (..., c, c), their scatter (..., c), and in which of them they differ."""
    values, axes = np.linalg.eigh(moments.scatter)
    return axes, values, values > moments.count[..., None] * options.least**2


def reach_variance(moments: Moments, options: TrendOptions) -> Array:
    """Variance of a slope relative to that of a motion, shape (..., c, c): unseen directions are the least known."""
    values, axes = np.linalg.eigh(moments.scatter)
    sureness = np.maximum(values, 0.0) + moments.count[..., None] * options.least**2
    return np.asarray(axes / sureness[..., None, :] @ np.swapaxes(axes, -1, -2), dtype=np.float64)


def limited(away: Array, radius: Array, options: TrendOptions) -> Array:
    """Distances (..., c) from the mean condition, as far as a trend is followed: softly ended beyond a radius (...,).

    Nobody has shown that the trend leads on there; within the radius nothing changes.
    """
    distances = np.sqrt(np.vecdot(away, away))
    if (distances <= radius).all():
        return away
    soft = np.maximum(options.softness * radius, _TINY)
    beyond = np.maximum(distances - radius, 0.0)
    followed = np.minimum(distances, radius) - soft * np.expm1(-beyond / soft)
    return np.asarray(away * (followed / np.maximum(distances, _TINY))[..., None], dtype=np.float64)


def _ridge(scatters: Array, count: Array, options: TrendOptions) -> Array:
    """That of the shrinkage 1, shape (...,): a third of the scatter in each direction, as many as they spread in."""
    total, squared = scatters.sum(axis=-1), np.sum(scatters**2, axis=-1)
    spread_in = np.maximum(total**2 / np.maximum(squared, _TINY), 1.0)
    return np.asarray(total / (3.0 * spread_in) + count * options.marker_noise**2, dtype=np.float64)


_TINY = 1e-300
