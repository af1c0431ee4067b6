"""What corrections do at a place."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from lfd.arrays import Array
from lfd.models.adaptive.covariance import Applied, Nearness
from lfd.models.adaptive.detour import Needed
from lfd.models.adaptive.kinds import POSITION
from lfd.models.model import ONLY_WAY, Way


@dataclass(frozen=True, eq=False)
class Place:
    """Where an effect is asked for.

    Attributes:
        z: The condition in units of the scale, shape (c,).
        outside: How far it lies outside what the demonstrations show, shape (c,).
        nearness: To the corrections.
        needed: What is needed there of each of their changes; None: all of it.
    """

    z: Array
    outside: Array
    nearness: Nearness
    needed: Needed | None

    @property
    def beyond(self) -> float:
        """The length of `outside`."""
        return float(np.sqrt(self.outside @ self.outside))


@dataclass(frozen=True, eq=False)
class Effect:
    """What corrections do at a place.

    Attributes:
        change: Of the vector, shape (D,).
        open_share: The share of the variance of positions that they have left: 1 far from all, nearly 0 at the newest.
        surprise: Mean square of what else might have changed there [m^2].
        evidence: How many corrections speak for it, at least 1.
        way: Which of the ways it is.
        others: How probable each other way is, and by what it differs (D,).
        beyond: How far it lies outside what the demonstrations show, in units of the corrections' scale.
    """

    change: Array
    open_share: float = 1.0
    surprise: float = 0.0
    evidence: float = 1.0
    way: Way = ONLY_WAY
    others: tuple[tuple[float, Array], ...] = ()
    beyond: float = 0.0

    @classmethod
    def of_positions(cls, change: Array, applied: Applied, beyond: float) -> Self:
        """That of a change (D,), of what of the corrections of positions applies there, and of `beyond`."""
        left, surprise, evidence = (float(x[POSITION]) for x in (applied.left, applied.surprise, applied.evidence))
        return cls(change, left, surprise, evidence, beyond=beyond)


def likeliest(probabilities: Array, effect: Callable[[int], Effect]) -> Effect:
    """That of the likeliest of several ways, which knows by what the others differ.

    Args:
        probabilities: Of the ways, shape (W,).
        effect: Of a way by itself.
    """
    chosen = int(probabilities.argmax())
    its = effect(chosen)
    others = [way for way, p in enumerate(probabilities.tolist()) if way != chosen and p > _IMPROBABLE]
    differences = [effect(way).change - its.change for way in others]
    way = Way(chosen, len(probabilities), float(probabilities[chosen]))
    return replace(its, way=way, others=tuple(zip(probabilities[others].tolist(), differences, strict=True)))


_IMPROBABLE = 0.01
