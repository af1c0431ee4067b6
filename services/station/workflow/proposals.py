"""Where an empty skill is to be shown a motion: its task's training places, each far from those before it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from protocol.messages import SceneState
from services.bus.arrays import vector3
from services.station.workflow.closure import SAME_PLACE_M
from services.station.workflow.guide import Guide
from services.station.workflow.state import Place

Array = NDArray[np.float64]

PLACES = 2
"""That an empty skill is shown a motion at, where its task has as many: between two a model knows what changes."""


def places(scene: SceneState) -> int:
    """How many places an empty skill of a scene is shown a motion at."""
    return min(PLACES, len(scene.training_places))


def proposed(scene: SceneState, guide: Guide, kept_at: Sequence[Sequence[float]] = ()) -> Place | None:
    """Where the next motion is to be shown: far from those before it, and nowhere twice while there is another place.

    Args:
        scene: whose training places they are.
        guide: how far it is.
        kept_at: where the target stood in the motions that the skill holds, as far as that is known [m].
    """
    spread = _spread(np.array(scene.training_places, dtype=np.float64))
    if not len(spread):
        return None
    # Of conditions it is not known which were shown.
    known = np.array(() if scene.condition else kept_at, dtype=np.float64).reshape(-1, len(spread[0]))
    free = [place for place in spread if not _is_among(place, known)] if len(known) else spread[guide.kept :]
    chosen = (free or spread)[guide.passed % len(free or spread)]
    return Place(condition=tuple(chosen.tolist())) if scene.condition else Place(vector3(chosen))


def _spread(places: Array) -> list[Array]:
    """Each as far as can be from those before it, beginning with the first; shape (n, d)."""
    left = list(places)
    spread: list[Array] = []
    while left:
        away = [min((float(np.linalg.norm(one - other)) for other in spread), default=0.0) for one in left]
        spread.append(left.pop(int(np.argmax(away))))
    return spread


def _is_among(place: Array, others: Array) -> bool:
    return bool(np.any(np.all(np.abs(others - place) <= SAME_PLACE_M, axis=1)))
