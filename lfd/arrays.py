"""Checked, read-only copies of arrays: what every value type of this package is made of."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lfd.exceptions import NotFinite, NotNumbers, NotUnitQuaternion, WrongShape

Array = NDArray[np.float64]

UNIT_TOLERANCE = 1e-3  # [-] what rounding to a few decimals in a recording does to a unit quaternion


def frozen(values: ArrayLike) -> Array:
    """A read-only copy of `values` as 64-bit floats, of the same shape."""
    array = np.array(values, dtype=np.float64)
    array.setflags(write=False)
    return array


def checked(name: str, values: ArrayLike, shape: tuple[int | None, ...]) -> Array:
    """A read-only copy of `values` that has the shape and is finite.

    Args:
        name: What the array is called in an error.
        values: The numbers.
        shape: The wanted shape; None stands for any length.

    Raises:
        NotNumbers: It holds something else than numbers, or rows of different lengths.
        WrongShape: The shape differs.
        NotFinite: A number is NaN or infinite.
    """
    try:
        array = frozen(values)
    except (TypeError, ValueError):
        raise NotNumbers(name) from None
    if array.ndim != len(shape) or any(want not in (None, have) for want, have in zip(shape, array.shape, strict=True)):
        expected = ", ".join("n" if length is None else str(length) for length in shape)
        raise WrongShape(name, f"({expected})", array.shape)
    # The sum of squares, in a third of the time, is finite but for numbers that are not, or such as 1e200.
    if not math.isfinite(np.vdot(array, array)):
        wrong = np.argwhere(~np.isfinite(array))
        if len(wrong):
            raise NotFinite(name, tuple(int(i) for i in wrong[0]))
    return array


def checked_quaternions(name: str, values: ArrayLike, shape: tuple[int | None, ...]) -> Array:
    """Quaternions (wxyz, in the last axis), checked to be unit and normalised to full precision.

    Args:
        name: What the array is called in an error.
        values: The numbers.
        shape: The wanted shape; None stands for any length.

    Raises:
        NotNumbers: It holds something else than numbers, or rows of different lengths.
        WrongShape: The shape differs.
        NotFinite: A number is NaN or infinite.
        NotUnitQuaternion: A norm differs from one by more than rounding does.
    """
    array = checked(name, values, shape)
    norms = np.sqrt(np.vecdot(array, array))[..., None]
    wrong = np.abs(norms - 1.0) > UNIT_TOLERANCE
    if wrong.any():
        first = int(np.flatnonzero(wrong)[0])
        raise NotUnitQuaternion(name, first, float(norms.flat[first]))
    unit: Array = array / norms
    unit.setflags(write=False)
    return unit
