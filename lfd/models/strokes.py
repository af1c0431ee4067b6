"""What a gripper does in a motion, as numbers that can be averaged: by how much it opens and closes, and when.

A gripper closes at once. As weights of smooth functions its opening would ring about the moment of closing; as values
at times the mean of one that closes early and one that closes late would be half closed between, and hold nothing. So
the moments are learnt: all that the fingers close in a motion is divided into equal shares, and each has the phase at
which it happens, and so has all that they open. The mean of two motions then closes at the mean of their moments,
whole; what was steady stays steady, and nothing swings (optimal transport: these are quantile functions, whose mean is
that of Wasserstein's metric).
"""

from itertools import pairwise

import numpy as np

from lfd.arrays import Array
from lfd.motion.opening import SAME_OPENING

SHARES = 32
"""Of all that the fingers open, and of all that they close, in a motion; each of them is of one size."""

OPENING_UNIT = 0.1
"""So much of an opening counts as much as all of a motion does of its moments [m]."""

LEVELS = 3
"""The opening at the start, all that opens and all that closes, in units."""

STROKES = LEVELS + 2 * SHARES
"""How many numbers these are: the levels, then the phases of what opens and of what closes."""

NEVER = 1.0
"""The phase of what does not happen: the end."""


def strokes_of(opening: Array, phases: Array) -> Array:
    """The numbers of a motion's opening, shape (STROKES,).

    Args:
        opening: At phases, shape (n,) [m]; what moves to and fro by less than `SAME_OPENING` counts as steady.
        phases: From 0 to 1, shape (n,).
    """
    steady = _steadied(opening)
    steps = np.diff(steady)
    opens, closes = (np.append(0.0, np.cumsum(np.maximum(way, 0.0))) for way in (steps, -steps))
    levels = np.array([steady[0], opens[-1], closes[-1]]) / OPENING_UNIT
    return np.concatenate([levels, _moments(opens, phases), _moments(closes, phases)])


def opening_of(strokes: Array, phases: Array, least: float, greatest: float) -> Array:
    """The opening that numbers (STROKES,) stand for at phases (T,), never beyond the least and the greatest, (T,) [m].

    Whatever the numbers are, as they may be sums and differences of motions: all that happens does so by the end.
    """
    moments = strokes[LEVELS:].reshape(2, SHARES).clip(0.0, NEVER)
    opened, closed = (moments[:, None] <= phases[:, None]).sum(axis=2) / SHARES
    first, opens, closes = strokes[:LEVELS]
    opening = first + max(opens, 0.0) * opened - max(closes, 0.0) * closed
    return np.asarray((OPENING_UNIT * opening).clip(least, greatest), dtype=np.float64)


def bounds_of(strokes: Array) -> tuple[float, float]:
    """The least and the greatest opening of motions of numbers (m, STROKES), at least one [m]."""
    openings = [opening_of(one, np.append(0.0, one[LEVELS:]).clip(0.0, NEVER), 0.0, np.inf) for one in strokes]
    return float(np.min(openings)), float(np.max(openings))


def _moments(done: Array, phases: Array) -> Array:
    """The phases at which each share of what is done in all is half done, shape (SHARES,), from what is done when."""
    if done[-1] == 0.0:
        return np.full(SHARES, NEVER)
    halves = (np.arange(SHARES) + 0.5) / SHARES
    return np.asarray(np.interp(halves * done[-1], done, phases), dtype=np.float64)


def _steadied(opening: Array) -> Array:
    """The opening (n,) between its turns, to each of which it leads without going back."""
    turns = _turns(opening)
    steady = np.full_like(opening, opening[turns[-1]])
    steady[: turns[0] + 1] = opening[turns[0]]
    for a, b in pairwise(turns):
        monotone = np.maximum if opening[b] > opening[a] else np.minimum
        steady[a : b + 1] = monotone.accumulate(opening[a : b + 1])
    return steady


def _turns(opening: Array) -> list[int]:
    """Where it is least and greatest in turn, each further than `SAME_OPENING` from the one before; at least one."""
    values = opening.tolist()
    turns: list[int] = []
    low = high = 0
    rising: bool | None = None  # nothing has moved yet
    for i, value in enumerate(values):
        if value < values[low]:
            low = i
        if value > values[high]:
            high = i
        if rising is not True and value - values[low] > SAME_OPENING:
            turns.append(low)
            rising, high = True, i
        elif rising is not False and values[high] - value > SAME_OPENING:
            turns.append(high)
            rising, low = False, i
    return [*turns, 0 if rising is None else high if rising else low]
