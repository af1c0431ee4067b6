"""A box in space, or of what else a few numbers say."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Region:
    """Box of places, both ends included.

    Attributes:
        lower: As many numbers as a place has [m].
        upper: The same.
    """

    lower: tuple[float, ...]
    upper: tuple[float, ...]

    def sample(self, rng: np.random.Generator) -> Array:
        """Draw a place evenly, shape (d,) [m]."""
        return rng.uniform(self.lower, self.upper)

    def contains(self, place: Array, margin: float = 0.0) -> bool:
        """Say whether the place lies inside, or at most a margin outside on each axis.

        Args:
            place: Shape (d,) [m]; one of another dimension lies outside.
            margin: [m].
        """
        fits = place.shape == (len(self.lower),)
        return fits and bool(
            np.all(place >= np.subtract(self.lower, margin)) and np.all(place <= np.add(self.upper, margin))
        )

    def grown(self, margin: float) -> "Region":
        """The box with a margin on each side [m]."""
        return Region(tuple(low - margin for low in self.lower), tuple(high + margin for high in self.upper))
