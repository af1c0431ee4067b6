"""How many programs want this machine's processors."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass

TOO_MANY = 4.0
"""Programs a processor, beyond which none runs when it should."""


@dataclass(frozen=True)
class Load:
    """Over the last minute.

    Attributes:
        wanting: programs that ran or waited to run, on average.
        processors: that there are.
    """

    wanting: float
    processors: int

    @property
    def is_too_much(self) -> bool:
        """What has to be in time is late."""
        return self.wanting > TOO_MANY * self.processors


Loads = Callable[[], Load | None]
"""Says the load now; None where that is not known."""


def load_now() -> Load | None:
    """Of this machine; None where its system does not tell."""
    try:
        wanting = os.getloadavg()[0]
    except (AttributeError, OSError):  # not every system has it
        return None
    return Load(wanting, os.cpu_count() or 1)


def no_load() -> None:
    """Of a machine of which it is not known."""
