"""The corrections of the way back are those of the way there."""

import numpy as np
import pytest

from services.robot.correction import Correction
from services.robot.passage import Passage


def correction(value):
    return Correction(np.array([value, 0.0, 0.0]), np.array([0.0, value, 0.0]))


def passed(times):
    """A passage whose correction is a tenth of the time."""
    passage = Passage()
    for time in times:
        passage.go_on(time, correction(0.1 * time))
    return passage


@pytest.mark.parametrize("time", [7.0, 6.25, 3.5, 0.3, 0.0])
def test_between_what_was_kept_it_is_on_the_line(time):
    back = passed(range(1, 9)).go_back(time)
    np.testing.assert_allclose(back.offset, [0.1 * time, 0.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(back.turn, [0.0, 0.1 * time, 0.0], atol=1e-12)


def test_what_was_passed_later_is_forgotten():
    passage = passed(range(1, 9))
    passage.go_back(4.0)
    passage.go_on(5.0, correction(9.0))
    np.testing.assert_allclose(passage.go_back(4.5).offset, [0.5 * (0.4 + 9.0), 0.0, 0.0])


def test_a_slow_way_is_remembered_as_well_as_a_fast_one():
    slow = passed(np.arange(0.01, 8.0, 0.01))
    for time in np.arange(7.99, 0.0, -0.37):
        np.testing.assert_allclose(slow.go_back(time).offset, [0.1 * time, 0.0, 0.0], atol=1e-12)
