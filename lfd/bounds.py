"""What numbers an option may have: one way to check them and to say so."""

import math
from dataclasses import dataclass
from enum import Enum
from numbers import Integral, Real

from lfd.exceptions import OutOfRange, TooFewPoints


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
SHARE = Bounds(0.0, 1.0, above=True)


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


def check_type(name: str, value: object, wanted: type) -> None:
    """Let a value of a type pass.

    Args:
        name: What it is called in an error.
        value: That a caller gave.
        wanted: Its type; where that is an enumeration, an error lists what there is.

    Raises:
        OutOfRange: It is of another type.
    """
    if not isinstance(value, wanted):
        choices = [f"{wanted.__name__}.{one.name}" for one in wanted] if issubclass(wanted, Enum) else []
        raise OutOfRange(name, value, f"one of {', '.join(choices)}" if choices else f"of type {wanted.__name__}")


def check_options(options: object, **allowed: Bounds | type) -> None:
    """Let a set of options pass whose numbers are within their bounds, and whose other values are of their types.

    Args:
        options: That have the named attributes.
        allowed: Bounds or type of each attribute, by its name.

    Raises:
        OutOfRange: One is not what is allowed; named as `Type.attribute`.
    """
    for name, wanted in allowed.items():
        called, value = f"{type(options).__name__}.{name}", getattr(options, name)
        if isinstance(wanted, Bounds):
            check_number(called, value, wanted)
        else:
            check_type(called, value, wanted)


def check_points(name: str, n: int) -> None:
    """Let a number of points pass that make a trajectory.

    Args:
        name: What has them, in an error.
        n: At least 2.

    Raises:
        TooFewPoints: There are fewer.
        OutOfRange: It is no whole number.
    """
    check_number(f"the number of points of the {name}", n, _WHOLE)
    if n < 2:
        raise TooFewPoints(name, n)


_WHOLE = Bounds(whole=True)
