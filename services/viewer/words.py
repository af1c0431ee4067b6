"""What is told in words: states that hold for a while, each a lane on the time line, and the journal."""

from __future__ import annotations

import numpy as np
import rerun as rr

from protocol.messages import Phase
from services.viewer import entities, palette
from services.viewer.journal import Entry
from services.viewer.kinds import WORDS
from services.viewer.news import Changes
from services.viewer.run import Run

# A state is told again this often: neither who comes late nor a recording's next file has heard the first time.
_REPEAT_S = 10.0

_PHASES = {
    Phase.IDLE: palette.QUIET,
    Phase.RAMP: palette.REFINED,
    Phase.EXECUTE: palette.GO,
    Phase.HOLD: palette.PREDICTED,
    Phase.STOPPED: palette.STOP,
}


class Words:
    """What is told in a run of the viewer.

    Args:
        run: where.
    """

    def __init__(self, run: Run) -> None:
        self._run = run
        self._changes = Changes(_REPEAT_S)
        colours = np.array(list(_PHASES.values()), dtype=np.uint32)
        phases = rr.StateConfiguration(values=[phase.value for phase in _PHASES], colors=colours)
        run.log_always(entities.PHASE, phases)

    def state(self, lane: str, text: str, now_ns: int) -> None:
        """Tell what holds from now on; nothing does where the text is empty."""
        if self._changes.due(lane, text, now_ns):
            self._run.row(lane, WORDS, text)

    def write(self, *entries: Entry) -> None:
        """Add to the journal."""
        for entry in entries:
            self._run.log(entities.JOURNAL, rr.TextLog(entry.text, level=entry.level))
