import math
from dataclasses import dataclass

import numpy as np
import pytest

from lfd.bounds import FINITE, FRACTION, NOT_NEGATIVE, POSITIVE, Bounds, at_least, check_options
from lfd.exceptions import OutOfRange

OPEN = Bounds(0.0, 1.0, above=True, below=True)


@pytest.mark.parametrize(
    ("bounds", "inside", "outside"),
    [
        (FINITE, [0, -1e300, np.float32(1.0), np.int64(3)], [math.nan, math.inf, -math.inf, None, "1", True, 1j]),
        (POSITIVE, [1e-300, 1], [0.0, -0.0, -1, math.nan, math.inf]),
        (NOT_NEGATIVE, [0, 0.0, 2.5], [-1e-300, math.inf]),
        (FRACTION, [0, 1, 0.5], [-1e-9, 1.0 + 1e-9, False]),
        (OPEN, [0.5], [0, 1]),
        (at_least(2), [2, np.int32(5), 10**6], [1, 2.0, "2", True]),
        (at_least(1, 3), [1, 3], [0, 4]),
    ],
)
def test_a_number_is_within_or_without(bounds, inside, outside):
    assert [value for value in inside if value not in bounds] == []
    assert [value for value in outside if value in bounds] == []


@pytest.mark.parametrize(
    ("bounds", "said"),
    [
        (FINITE, "a finite number"),
        (POSITIVE, "a finite number, above 0"),
        (FRACTION, "a finite number, at least 0 and at most 1"),
        (OPEN, "a finite number, above 0 and below 1"),
        (at_least(2), "a whole number, at least 2"),
    ],
)
def test_bounds_are_said_in_words(bounds, said):
    assert str(bounds) == said


@dataclass(frozen=True)
class Options:
    count: object = 2
    width: object = 0.5


def test_the_option_the_value_and_the_bound_are_named():
    check_options(Options(), count=at_least(2), width=POSITIVE)
    with pytest.raises(OutOfRange) as caught:
        check_options(Options(width=-0.5), count=at_least(2), width=POSITIVE)
    assert (caught.value.name, caught.value.value, caught.value.allowed) == (
        "Options.width",
        -0.5,
        "a finite number, above 0",
    )
    with pytest.raises(OutOfRange, match=r"Options\.count is 'ten': it must be a whole number, at least 2"):
        check_options(Options(count="ten"), count=at_least(2))
