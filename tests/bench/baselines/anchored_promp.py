"""The thesis' model in start-anchored weights, everything else as it is."""

from typing import Self

from lfd.models.promp import ConditionedProMP, PrompOptions


class AnchoredProMP(ConditionedProMP):
    """See `ConditionedProMP`; the prediction begins exactly at the start pose."""

    @classmethod
    def fit(cls, demonstrations, options=None) -> Self:
        return super().fit(demonstrations, options or PrompOptions(anchored=True))
