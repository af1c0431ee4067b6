"""Dynamic time warping: exact, with the path.

Two routes give the same distance and path to the last bit: NumPy over anti-diagonals, and loops that Numba compiles,
where it is installed (extra `compiled`). For two sequences of 75 points in 7 dimensions they take 0.6 and 0.04 ms, for
780 points 15 and 1.4 ms, for 5000 points 500 and 65 ms (`deploy/bench lfd`). But to load Numba takes a process one
second and 120 MB, so it is loaded at the first long alignment, and from then on serves the short ones too. It keeps
what it compiled beside this file or, where that cannot be written, in the user's cache.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lfd.arrays import Array, checked
from lfd.exceptions import NotFinite, WrongShape

Steps = NDArray[np.uint8]

# How a cell is reached: the first of these that is cheapest.
_DIAGONAL, _UP, _LEFT = 2, 0, 1  # from (i - 1, j - 1), (i - 1, j), (i, j - 1)

_LONG_CELLS = 500_000  # the size of an alignment that loads Numba: a dozen of them by NumPy take as long as that
_BLOCK_CELLS = 1 << 15  # local distances that the NumPy route forms at once: a quarter of a megabyte


@dataclass(frozen=True, eq=False)
class Alignment:
    """The cheapest monotonic matching of two sequences.

    Attributes:
        distance: Sum of the Euclidean distances along the path.
        path: Matched indices (i, j), shape (L, 2), from (0, 0) to (n - 1, m - 1); each step raises i, j or both by 1.
    """

    distance: float
    path: NDArray[np.intp]


def dtw(a: ArrayLike, b: ArrayLike) -> Alignment:
    """Exact dynamic time warping of a (n, d) and b (m, d): equation (D.1) with the Euclidean distance, in their unit.

    Time is O(n m); memory is one byte for each of the n m cells, and a few rows. Of equally cheap paths the one is
    taken that goes, from the end, diagonally where it can, and else back in a.

    Raises:
        WrongShape: A sequence is empty or not of shape (length, d), or the two differ in d.
        NotFinite: A number is NaN or infinite, or so large that the distance is.
    """
    x, y = _checked_sequence("a", a), _checked_sequence("b", b)
    if x.shape[1] != y.shape[1]:
        raise WrongShape("b", f"(n, {x.shape[1]})", y.shape)
    route = _route(len(x) * len(y))
    with np.errstate(over="ignore"):
        distance, steps = route.accumulate(np.array(x, order="C"), np.array(y.T, order="C"))
    if not math.isfinite(distance):
        raise NotFinite("the distance of a and b", ())
    return Alignment(distance, route.trace(steps))


def _checked_sequence(name: str, values: ArrayLike) -> Array:
    sequence = checked(name, values, (None, None))
    if sequence.size == 0:
        raise WrongShape(name, "(n, d) with n and d at least 1", sequence.shape)
    return sequence


class _Route(NamedTuple):
    """How to align.

    Attributes:
        accumulate: From a (n, d) and the transpose of b (d, m) to the distance and the steps (n, m).
        trace: From the steps to the path (L, 2).
    """

    accumulate: Callable[[Array, Array], tuple[float, Steps]]
    trace: Callable[[Steps], NDArray[np.intp]]


def _route(cells: int) -> _Route:
    loaded = _compiled_route.cache_info().currsize > 0
    return _compiled_route() if loaded or cells >= _LONG_CELLS else _NUMPY_ROUTE


@cache
def _compiled_route() -> _Route:
    """The route by Numba, or where that is not installed the other one."""
    try:
        numba = import_module("numba")
    except ImportError:
        return _NUMPY_ROUTE
    accumulate = _compiled(numba, "Tuple((f8, u1[:, ::1]))(f8[:, ::1], f8[:, ::1])", _accumulate_by_rows)
    return _Route(accumulate, _compiled(numba, "i8[:, :](u1[:, ::1])", _trace))


def _compiled(numba: Any, signature: str, function: Callable[..., Any]) -> Any:
    # Without fast-math the compiler keeps the order of all operations: both routes agree to the last bit.
    try:
        return numba.njit(signature, cache=True)(function)
    except (OSError, RuntimeError):  # there is no folder where a cache can be written
        return numba.njit(signature)(function)


def _accumulate_by_rows(a: Array, b: Array) -> tuple[float, Steps]:
    """The recursion row by row, to be compiled. All inner loops but the last are independent from j to j: SIMD."""
    (n, d), m = a.shape, b.shape[1]
    steps = np.empty((n, m), np.uint8)
    total = np.full(m + 1, np.inf)  # of the row before; entry j + 1 is column j
    total[0] = 0.0  # the virtual cell (-1, -1) before the start
    local, before = np.empty(m), np.empty(m)
    for i in range(n):
        step = steps[i]
        local[:] = 0.0
        for k in range(d):
            for j in range(m):
                difference = a[i, k] - b[k, j]
                local[j] += difference * difference
        for j in range(m):
            local[j] = math.sqrt(local[j])
        for j in range(m):
            diagonal, up = total[j], total[j + 1]
            step[j] = _UP if up < diagonal else _DIAGONAL
            before[j] = up if up < diagonal else diagonal
        left = np.inf
        total[0] = np.inf
        for j in range(m):
            cheapest = before[j]
            if left < cheapest:
                cheapest = left
                step[j] = _LEFT
            left = cheapest + local[j]
            total[j + 1] = left
    return float(total[m]), steps


def _accumulate_by_diagonals(a: Array, b: Array) -> tuple[float, Steps]:
    """The recursion over the diagonals i + j = k, whose cells do not depend on each other, in blocks of diagonals."""
    n, m = len(a), b.shape[1]
    steps = np.empty((n, m + 1), np.uint8)  # with a spare column the diagonal k is every m-th byte from byte k on
    flat = steps.ravel()
    count = math.ceil(_BLOCK_CELLS / n)
    total = np.full((count + 2, n + 1), np.inf)  # two diagonals, then the block's; entry i + 1 is row i of the matrix
    total[-2, 0] = 0.0  # the virtual cell (-1, -1) before the start
    cheapest = np.empty(n)
    for start, first, local in _local_distances(a, b, count):
        (height, width), last = local.shape, first + local.shape[1]
        total[:2], total[2:] = total[-2:], np.inf
        diagonal, up = total[:height, first:last], total[1 : height + 1, first:last]
        left, here = total[1 : height + 1, first + 1 : last + 1], total[2 : height + 2, first + 1 : last + 1]
        least = cheapest[:width]
        for arrival, above, beside, distance, result in zip(diagonal, up, left, local, here, strict=True):
            np.minimum(above, beside, out=least)
            np.minimum(arrival, least, out=least)
            np.add(least, distance, out=result)
        step = np.less(left, up).view(np.uint8)  # _LEFT or _UP
        step[(diagonal <= up) & (diagonal <= left)] = _DIAGONAL
        for k, row in enumerate(step, start):
            top, bottom = max(0, k - m + 1), min(k + 1, n)
            flat[k + top * m : k + bottom * m : m] = row[top - first : bottom - first]
    return float(total[height + 1, n]), steps[:, :m]


def _local_distances(a: Array, b: Array, count: int) -> Iterator[tuple[int, int, Array]]:
    """The Euclidean distances of a_i and b_(k - i), for `count` diagonals k at a time.

    Yields:
        The first k, the first i, and the distances, with a row for each k and a column for each i that the diagonals
        reach; infinite outside the matrix. The array is used again for the next diagonals.
    """
    n, m = len(a), b.shape[1]
    # Backwards b runs along a diagonal as a does: a_i on diagonal k meets entry n + m - 1 - k + i.
    backwards = np.pad(b[:, ::-1], ((0, 0), (n, n)), constant_values=np.inf)
    buffers = np.empty((2, count * n))  # kept, because fresh memory costs more than the arithmetic
    for start in range(0, n + m - 1, count):
        stop = min(start + count, n + m - 1)
        first, last = max(0, start - m + 1), min(stop, n)
        shape = stop - start, last - first
        squared, difference = buffers[:, : math.prod(shape)].reshape(2, *shape)
        facing = np.lib.stride_tricks.sliding_window_view(backwards, last - first, axis=1)
        facing = facing[:, n + m + first - stop : n + m + first - start][:, ::-1]
        squared[:] = 0.0
        for x, y in zip(a[first:last].T, facing, strict=True):
            np.subtract(x, y, out=difference)
            np.multiply(difference, difference, out=difference)
            np.add(squared, difference, out=squared)
        yield start, first, np.sqrt(squared, out=squared)


def _trace(steps: Steps) -> NDArray[np.intp]:
    """The path back along the steps (n, m), in the order from the start."""
    n, m = steps.shape
    path = np.empty((n + m - 1, 2), np.intp)
    i, j, at = n - 1, m - 1, n + m - 2
    path[at] = i, j
    while i > 0 or j > 0:
        step = steps[i, j]
        if step != _LEFT:
            i -= 1
        if step != _UP:
            j -= 1
        at -= 1
        path[at, 0] = i
        path[at, 1] = j
    return path[at:]


_NUMPY_ROUTE = _Route(_accumulate_by_diagonals, _trace)
