"""What the messages of a run say of the way from hand to eye, stage by stage."""

from dataclasses import astuple

import numpy as np

from services.bus.stages import NAMES
from tests.bench.support.results import Result


class OwnPath:
    """As page, recording and `retouch top` tell it; what nobody knows is not counted."""

    def __init__(self):
        self._known = {name: [] for name in NAMES}

    def keep(self, stages):
        """What one message says."""
        for name, value in zip(NAMES, astuple(stages), strict=True):
            if value is not None:
                self._known[name].append(1e3 * value)

    def results(self):
        """Of the stages that are known, in their order."""
        for name, known in self._known.items():
            if known:
                yield Result(f"stage {name}, p50", float(np.percentile(known, 50)), "ms")
                yield Result(f"stage {name}, p99", float(np.percentile(known, 99)), "ms")
