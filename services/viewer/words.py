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
    Phase.RAMP.value: palette.REFINED,
    Phase.EXECUTE.value: palette.GO,
    Phase.HOLD.value: palette.PREDICTED,
    Phase.STOPPED.value: palette.STOP,
}

_LANES = {
    entities.CLAMPED: palette.FORCE,
    entities.ENGAGED: palette.GO,
    entities.HOLD: palette.PREDICTED,
    entities.KEYS: palette.OBJECT,
    entities.STOP: palette.STOP,
}

# Colours are kept for so many texts of a lane; Rerun has its own for the others.
_COLOURED = 64


class Words:
    """What is told in a run of the viewer.

    Args:
        run: where.
    """

    def __init__(self, run: Run) -> None:
        self._run = run
        self._changes = Changes(_REPEAT_S)
        self._colours: dict[str, dict[str, int]] = {}

    def state(self, lane: str, text: str, now_ns: int) -> None:
        """Tell what holds from now on; nothing does where the text is empty."""
        if self._changes.due(lane, text, now_ns):
            self._colour(lane, text)
            self._run.row(lane, WORDS, text)

    def write(self, *entries: Entry) -> None:
        """Add to the journal."""
        for entry in entries:
            self._run.log(entities.JOURNAL, rr.TextLog(entry.text, level=entry.level))

    def _colour(self, lane: str, text: str) -> None:
        """Give a text of a lane its colour: Rerun's own would make an alarm of anything."""
        known = self._colours.setdefault(lane, {})
        if not text or text in known or len(known) == _COLOURED:
            return
        known[text] = _PHASES.get(text, _LANES.get(lane, palette.QUIET))
        colours = np.array(list(known.values()), dtype=np.uint32)
        self._run.log_always(lane, rr.StateConfiguration(values=list(known), colors=colours))
