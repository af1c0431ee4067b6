"""The newest predictions by their ids, as whoever hears the model knows them."""

from __future__ import annotations

from protocol.messages import Motion, Prediction
from protocol.topics import PREDICTION
from services.bus.bus import Bus

KEPT = 8
"""An execution names the newest one; those before it are for whoever comes late."""


class Predictions:
    """Remembers the last predictions; the first one of an id stays, whatever else is announced under it.

    Args:
        bus: on which the model announces them.
    """

    def __init__(self, bus: Bus) -> None:
        self._heard = bus.subscribe(PREDICTION)
        self._known: dict[int, Prediction] = {}

    def newest(self) -> Prediction | None:
        """The one that was announced last; None before the first."""
        received = self._heard.latest()
        return received.message if received is not None else None

    def find(self, identity: int) -> Prediction | None:
        """The prediction of an id; None where none was heard, or too many since."""
        for received in self._heard.take():
            prediction = received.message
            if prediction.id:
                self._known.setdefault(prediction.id, prediction)
        while len(self._known) > KEPT:
            del self._known[next(iter(self._known))]
        return self._known.get(identity)

    def motion(self, identity: int) -> Motion | None:
        """The motion that was predicted under an id; None as of `find`."""
        prediction = self.find(identity)
        return prediction.motion if prediction is not None else None
