"""The models that can be learnt, and the one that a history of demonstrations makes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from lfd.models.adaptive.adaptation import AdaptiveProMP
from lfd.models.model import MovementModel
from lfd.models.promp import ConditionedProMP
from lfd.motion.demonstration import Demonstration
from lfd.store.stored import Purpose, StoredDemonstration

Fit = Callable[[Sequence[Demonstration]], MovementModel]
"""Makes a model of its first demonstrations."""

MODELS: Mapping[str, Fit] = {
    "adaptive": AdaptiveProMP.fit,
    "promp": ConditionedProMP.fit,
}
"""By the name that a configuration calls them by."""


def learn_all(
    kind: str, stored: Sequence[StoredDemonstration], models: Mapping[str, Fit] = MODELS
) -> MovementModel | None:
    """The model that stored demonstrations make.

    Args:
        kind: of the model, a key of `models`.
        stored: in the order in which they came.
        models: to choose from.

    Returns:
        The model; None before the first demonstration.
    """
    initial = [s.demonstration for s in stored if s.purpose is Purpose.INITIAL]
    updates = [s.demonstration for s in stored if s.purpose is Purpose.UPDATE]
    if not initial:
        initial, updates = updates[:1], updates[1:]
    if not initial:
        return None
    model = models[kind](initial)
    for update in updates:
        model = model.updated(update)
    return model
