"""What corrections do at a place."""

from dataclasses import dataclass

from lfd.arrays import Array
from lfd.models.model import ONLY_WAY, Way


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
    """

    change: Array
    open_share: float = 1.0
    surprise: float = 0.0
    evidence: float = 1.0
    way: Way = ONLY_WAY
    others: tuple[tuple[float, Array], ...] = ()
