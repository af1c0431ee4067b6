"""Where a demonstration comes from, and how far it is believed."""

from dataclasses import dataclass
from enum import Enum

from lfd.bounds import FINITE, FRACTION, check_number, check_options


class Method(Enum):
    """How a person gave a demonstration (the thesis' online and offline methods)."""

    UNKNOWN = ""
    REFINE = "refine"  # online: corrected while the robot executed it
    WAYPOINTS = "waypoints"  # offline: a motion through some poses
    DEMONSTRATE = "demonstrate"  # offline: led by hand from its start to its end


@dataclass(frozen=True)
class Provenance:
    """Who gave a demonstration or correction, when and how, and how sure of it they are.

    Attributes:
        author: Who gave it; empty where that is not known.
        at_s: When it was given, in seconds since 1970-01-01 UTC; None where that is not known.
        confidence: How far a correction is to move a prediction towards itself, from 0, not at all, to 1, all the way:
            alpha of equation (18), which the thesis would have follow "the confidence of the operator in its
            refinement".
        method: How it was given.

    Raises:
        OutOfRange: The confidence is not from 0 to 1, or the time not finite.
    """

    author: str = ""
    at_s: float | None = None
    confidence: float = 1.0
    method: Method = Method.UNKNOWN

    def __post_init__(self) -> None:
        check_options(self, confidence=FRACTION)
        if self.at_s is not None:
            check_number("Provenance.at_s", self.at_s, FINITE)


UNKNOWN = Provenance()
