"""The way that a person has in mind when they correct a motion: one of those that they know, as they remember it."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from sim.interpolation import covered_shares, numbers_at, through
from sim.person.scatter import deviation
from sim.tasks.scene import Corridor, Freedom

Array = NDArray[np.float64]

_INDIFFERENCE = 0.02  # [m] of difference between two ways' departures from the motion, at which a person still wavers
_EVIDENT = 0.05  # [m] of a correction, from which on it is evident on which side of the way there is room


def departure(way: Corridor, positions: Array) -> float:
    """Root mean square distance between a way and a motion at equal shares of their lengths [m].

    Args:
        way: The way.
        positions: Of the motion, shape (n, 3) [m].
    """
    apart = through(way.positions, numbers_at(way.positions, covered_shares(positions))) - positions
    return float(np.sqrt(np.mean(np.sum(apart**2, axis=1))))


def _aims(way: Corridor, shares: Array) -> tuple[float, ...]:
    """The shares of a way, before its end, at which the hand stands while the gripper moves."""
    if way.openings is None:
        return ()
    return tuple(shares[1:][np.diff(way.openings) != 0.0].tolist())


def chosen(ways: Sequence[Corridor], positions: Array, rng: np.random.Generator) -> Corridor:
    """Choose the way that changes the motion least; where two change it alike, chance decides.

    Probabilities are those of a logistic choice: proportional to exp(-departure / indifference).

    Args:
        ways: To choose from, one at least.
        positions: What the robot would do, shape (n, 3) [m].
        rng: Of the choice.
    """
    cost = np.array([departure(way, positions) for way in ways]) / _INDIFFERENCE
    weights = np.exp(cost.min() - cost)
    return ways[int(rng.choice(len(ways), p=weights / weights.sum()))]


def imagined(
    way: Corridor,
    motion: Array,
    scatter: float,
    rng: np.random.Generator,
    freedom: Freedom,
) -> Corridor:
    """A way as a person has it in mind this time: off by their scatter, and rather too far from what they avoid.

    Whoever leads a robot off a way because something stands there errs to the side that they lead it to: what of the
    deviation leads back is turned round.

    Args:
        way: That they mean.
        motion: What the robot would do, shape (n, 3) [m].
        scatter: Of the person, see `deviation` [m].
        rng: Of this time's deviation.
        freedom: Of the person.
    """
    even = np.linspace(0.0, 1.0, len(way.positions))
    shares = covered_shares(way.positions) if freedom.tempo else even
    numbers = numbers_at(motion, shares) if freedom.tempo else (len(motion) - 1) * shares
    aims = (*freedom.targets, *_aims(way, shares))
    deviates = freedom.axes * deviation(shares, scatter, rng, aims)
    away = way.positions - through(motion, numbers)
    far = np.linalg.norm(away, axis=1, keepdims=True)
    along = away / np.maximum(far, 1e-9)
    back = np.minimum(np.sum(deviates * along, axis=1, keepdims=True), 0.0)
    evident = np.clip(far / _EVIDENT, 0.0, 1.0)
    return way._replace(positions=way.positions + deviates - 2.0 * evident * back * along)
