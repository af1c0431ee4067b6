"""How sure a prediction is, in the words of the table."""

from __future__ import annotations

from protocol.messages import Part, Prediction, Way
from services.station.words.table import say


def certainty(prediction: Prediction) -> str:
    """How much of a prediction is known, and which of several ways it takes."""
    known = say("figure.known", share=share(prediction.known))
    return ", ".join(part for part in (known, way_taken(prediction.way)) if part)


def way_taken(way: Way) -> str:
    """Which of several ways, and how sure that is; empty where there is only one."""
    if way.count <= 1:
        return ""
    return say("figure.way", number=way.index + 1, count=way.count, share=share(way.probability))


def extent(part: Part) -> str:
    """From where to where a part is, to be put behind a sentence; empty for the whole motion."""
    if part == Part():
        return ""
    if part.first == 0.0:
        return say("extent.up_to", last=share(part.last))
    if part.last == 1.0:
        return say("extent.from", first=share(part.first))
    return say("extent.between", first=share(part.first), last=share(part.last))


def share(value: float) -> str:
    """A share from 0 to 1 as a number of hundredths."""
    return f"{100.0 * value:.0f}"
