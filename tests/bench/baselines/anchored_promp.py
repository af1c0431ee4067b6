"""The thesis' model in start-anchored weights, everything else as it is."""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from lfd.models.encoding import Encoding
from lfd.models.gaussian import JointGaussian
from lfd.models.promp import CONDITION_SCALE, ConditionedProMP, PrompOptions
from lfd.motion.alignment import align


@dataclass(frozen=True, eq=False)
class AnchoredProMP(ConditionedProMP):
    """See `ConditionedProMP`; the prediction begins exactly at the start pose."""

    @classmethod
    def fit(cls, demonstrations, options=None) -> Self:
        options = options or PrompOptions()
        plain = ConditionedProMP.fit(demonstrations, options)
        encoding: Encoding = replace(plain.encoding, anchored=True)
        aligned = align(demonstrations, selection=options.selection)
        samples = [np.append(encoding.encode(d), CONDITION_SCALE * d.condition) for d in aligned]
        return cls(encoding, JointGaussian.fit(np.array(samples)), options)
