"""In a training the model keeps nothing: what a success taught it is taken back, so that the next attempt is as hard.

The robot's processes go on meanwhile: nobody waits for a new start, and where this one does it finds what is left.
"""

from __future__ import annotations

from protocol import queries
from protocol.messages import Purpose
from protocol.queries import Learnt, Undo
from protocol.topics import MODEL_STATE
from services.bus.bus import Bus, Pending
from services.bus.identity import new_number


class Forgetting:
    """Takes every update back that the model says it has.

    Args:
        bus: to the model.
        operator: in whose name.
    """

    def __init__(self, bus: Bus, operator: str) -> None:
        self._bus = bus
        self._operator = operator
        self._model = bus.subscribe(MODEL_STATE)
        self._pending: Pending[Learnt] | None = None
        self._version = 0

    def step(self) -> None:
        """Ask, where there is something to take back that was not asked for yet."""
        if self._pending is not None:
            outcome = self._pending.poll()
            if outcome is None:
                return
            self._pending = None
            # What is refused or not answered is asked again, of the version that is there then.
            self._version = outcome.state.version if isinstance(outcome, Learnt) else 0
        known = self._model.latest()
        if known is not None and known.message.updates and known.message.version > self._version:
            undo = Undo(purpose=Purpose.UPDATE, operator=self._operator, request=new_number())
            self._pending = self._bus.ask(queries.UNDO, undo)
