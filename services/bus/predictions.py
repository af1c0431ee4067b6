"""The newest predictions by their ids, as whoever hears the model knows them, and how sure they are, in words."""

from __future__ import annotations

from protocol.messages import ExecutionState, Motion, Prediction, Way
from protocol.topics import PREDICTION
from services.bus.bus import Bus

KEPT = 8
"""An execution names the newest one; those before it are for whoever comes late."""


LITTLE = 0.5
"""Where less of a motion is known than this, it is better shown than executed."""


def certainty(prediction: Prediction) -> str:
    """How much of a prediction is known, and which of several ways it takes, for people."""
    way = way_taken(prediction.way)
    return f"{percent(prediction.known)} known{', ' if way else ''}{way}"


def way_taken(way: Way) -> str:
    """Which of several ways, and how sure that is; empty where there is only one."""
    return f"way {way.index + 1} of {way.count}, {percent(way.probability)}" if way.count > 1 else ""


def percent(share: float) -> str:
    """A share from 0 to 1, for people."""
    return f"{100.0 * share:.0f} %"


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

    def shown(self, execution: ExecutionState | None) -> Prediction | None:
        """The one to see: of the motion that is under way, whatever was predicted since; else the newest."""
        return self.newest() if execution is None else self.find(execution.prediction)

    def motion(self, identity: int) -> Motion | None:
        """The motion that was predicted under an id; None as of `find`."""
        prediction = self.find(identity)
        return prediction.motion if prediction is not None else None
