"""Where the target of an episode is put: at the one place that is set, or where the dice say."""

from __future__ import annotations

import numpy as np

from protocol.messages import SceneState
from services.bus.arrays import vector3
from services.station.workflow.state import Place


class Draw:
    """Of one run.

    Args:
        place: of the target in every episode, as the scene counts it; empty where it is drawn.
        seed: of the random numbers.
    """

    def __init__(self, place: tuple[float, ...], seed: int) -> None:
        self._place = place
        self._random = np.random.default_rng(seed)
        self._drawn: Place | None = None

    def of(self, scene: SceneState | None) -> Place | None:
        """The place, the same until it is taken; None before the scene is known."""
        if scene is not None and self._drawn is None:
            low, high = scene.condition_region if scene.condition else scene.object_region
            random = tuple(float(self._random.uniform(a, b)) for a, b in zip(low, high, strict=True))
            drawn = self._place or random
            self._drawn = Place(condition=drawn) if scene.condition else Place(object_position=vector3(drawn))
        return self._drawn

    def taken(self) -> None:
        """The next one is another."""
        self._drawn = None
