"""Which part of a motion a demonstration speaks of."""

from lfd.bounds import FRACTION, check_number
from lfd.exceptions import EmptyPart

Part = tuple[float, float]
"""Phases from the first to the last, each from 0 to 1."""

WHOLE: Part = (0.0, 1.0)


def check_part(part: Part) -> None:
    """Let pass a part that holds some of the motion.

    Args:
        part: First and last phase.

    Raises:
        OutOfRange: A phase is not from 0 to 1.
        EmptyPart: It does not end after it begins.
    """
    first, last = part
    check_number("the part's first phase", first, FRACTION)
    check_number("the part's last phase", last, FRACTION)
    if not first < last:
        raise EmptyPart(first, last)
