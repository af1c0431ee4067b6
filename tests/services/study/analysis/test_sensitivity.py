"""What a study could have shown is what simulated studies show; where they can show nothing, that is said."""

import numpy as np
import pytest

from services.study.analysis.analysis import analysed
from services.study.analysis.hypotheses import Direction, Plan
from services.study.analysis.ranks import signed_rank
from services.study.analysis.reporting import Reporting, appendix
from services.study.analysis.sensitivity import detectable
from tests.services.study.analysis.studies import study


def power(people, shift, level):
    """Share of simulated samples that the exact test finds."""
    rng = np.random.default_rng(11)
    samples = rng.normal(shift, 1.0, (4000, people))
    return np.mean([signed_rank(one, Direction.GREATER).p <= level for one in samples])


@pytest.mark.parametrize("people", [6, 12, 18])
@pytest.mark.parametrize("level", [0.05, 0.05 / 3.0])
def test_the_shift_that_is_told_is_found_as_often_as_is_told(people, level):
    assert power(people, detectable(people, level), level) == pytest.approx(0.8, abs=0.03)


@pytest.mark.parametrize(("people", "level"), [(2, 0.05), (4, 0.05), (6, 0.0125)])
def test_where_the_smallest_p_is_above_the_level_no_shift_is_found(people, level):
    assert detectable(people, level) is None
    assert power(people, 100.0, level) == 0.0


def told(people):
    """What the appendix says of the thesis' four hypotheses."""
    observations = study(np.random.default_rng(1), people=people)
    items = {one.name: one.text for one in appendix(observations, analysed(observations, Plan()), Reporting())}
    return items["Sensitivity"]


def test_too_few_people_are_told_that_they_can_show_nothing():
    assert told(6).startswith("nothing can be shown with 6 participants: the exact test's smallest p is 0.016")
    assert "power" not in told(6)
    assert told(7).startswith("found with 80 % power")
