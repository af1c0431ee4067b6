"""The corrections as they were applied along the way, so that the arm can go back the way that it came."""

from __future__ import annotations

from services.robot.correction import UNCORRECTED, Correction

DENSEST = 0.5
"""Of what is kept: a slow motion takes no more room than one at its own pace [control periods]."""


class Passage:
    """What was passed, in the order of the prediction's time [control periods]; it begins without a correction."""

    def __init__(self) -> None:
        self._times = [0.0]
        self._corrections = [UNCORRECTED]

    def go_on(self, time: float, correction: Correction) -> None:
        """A later time was reached, with a correction."""
        if len(self._times) > 1 and self._times[-1] - self._times[-2] < DENSEST:
            self._times[-1], self._corrections[-1] = time, correction
        else:
            self._times.append(time)
            self._corrections.append(correction)

    def go_back(self, time: float) -> Correction:
        """The correction that was applied at an earlier time; what was passed later is forgotten."""
        later = self._times[-1], self._corrections[-1]
        while len(self._times) > 1 and self._times[-1] > time:
            later = self._times.pop(), self._corrections.pop()
        before, correction = self._times[-1], self._corrections[-1]
        if later[0] > before:
            correction = correction.towards(later[1], (time - before) / (later[0] - before))
        self.go_on(time, correction)
        return correction
