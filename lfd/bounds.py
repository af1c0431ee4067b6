"""What numbers an option may have: one way to check them and to say so."""

import math
from dataclasses import dataclass
from numbers import Integral, Real

from lfd.exceptions import OutOfRange


@dataclass(frozen=True)
class Bounds:
    """An interval of finite numbers.

    Attributes:
        least: Lower end.
        most: Upper end.
        above: The lower end itself does not count.
        below: The upper end itself does not count.
        whole: Only whole numbers do.
    """

    least: float = -math.inf
    most: float = math.inf
    above: bool = False
    below: bool = False
    whole: bool = False

    def __contains__(self, value: object) -> bool:
        if isinstance(value, bool) or not isinstance(value, Integral if self.whole else Real):
            return False
        number = float(value)
        low = number > self.least if self.above else number >= self.least
        high = number < self.most if self.below else number <= self.most
        return low and high and math.isfinite(number)

    def __str__(self) -> str:
        ends = []
        if self.least > -math.inf:
            ends.append(f"{'above' if self.above else 'at least'} {self.least:g}")
        if self.most < math.inf:
            ends.append(f"{'below' if self.below else 'at most'} {self.most:g}")
        kind = "a whole number" if self.whole else "a finite number"
        return f"{kind}, {' and '.join(ends)}" if ends else kind


FINITE = Bounds()
POSITIVE = Bounds(0.0, above=True)
NOT_NEGATIVE = Bounds(0.0)
FRACTION = Bounds(0.0, 1.0)


def at_least(least: int, most: float = math.inf) -> Bounds:
    """The whole numbers from `least` on, up to `most`."""
    return Bounds(least, most, whole=True)


def check_number(name: str, value: object, bounds: Bounds) -> None:
    """Let a number within its bounds pass.

    Args:
        name: What it is called in an error.
        value: That a caller gave; anything that is no number is outside.
        bounds: Of it.

    Raises:
        OutOfRange: It is not within them.
    """
    if value not in bounds:
        raise OutOfRange(name, value, str(bounds))


def check_options(options: object, **bounds: Bounds) -> None:
    """Let a set of options pass whose numbers are within their bounds.

    Args:
        options: That have the named attributes.
        bounds: Of each attribute, by its name.

    Raises:
        OutOfRange: One is not within them; named as `Type.attribute`.
    """
    for name, within in bounds.items():
        check_number(f"{type(options).__name__}.{name}", getattr(options, name), within)
