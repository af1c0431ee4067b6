"""How much less what was learnt is believed for its age."""

from collections.abc import Sequence

import numpy as np

from lfd.arrays import Array


def aged(times: Sequence[float | None], half_life_s: float | None) -> Array:
    """The variance that age adds, relative to what could have changed: 1 at the half-life, shape (J,).

    Args:
        times: In seconds; one that is not known is as new as the newest.
        half_life_s: Age at which one counts half as much as a new one [s]; None: nothing ages.
    """
    if half_life_s is None or all(time is None for time in times):
        return np.zeros(len(times))
    known = np.array([np.nan if time is None else time for time in times])
    ages = np.nan_to_num(np.nanmax(known) - known, nan=0.0)
    return np.asarray(np.exp2(np.minimum(ages / half_life_s, _OLDEST)) - 1.0, dtype=np.float64)


_OLDEST = 60.0  # half-lives, after which it counts for nothing
