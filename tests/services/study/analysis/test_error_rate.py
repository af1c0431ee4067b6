"""How often the confirmatory tests are wrong where there is nothing, and right where there is something."""

import numpy as np
import pytest

from services.study.analysis.comparison import confirmatory
from services.study.analysis.hypotheses import THESIS_HYPOTHESES, Plan
from tests.services.study.analysis.studies import study

STUDIES = 2_000
ALPHA = 0.05


@pytest.fixture(scope="module")
def null_studies():
    rng = np.random.default_rng(2026)
    return [study(rng, people=18, models=3) for _ in range(STUDIES)]


@pytest.mark.sim
def test_a_study_of_nothing_finds_something_in_five_of_a_hundred(null_studies):
    found = [min(confirmatory(one, Plan()).values()) <= ALPHA for one in null_studies]
    assert np.mean(found) == pytest.approx(ALPHA, abs=0.01)


@pytest.mark.sim
def test_one_hypothesis_alone_has_the_same_rate(null_studies):
    plan = Plan(hypotheses=THESIS_HYPOTHESES[1:2])
    found = [confirmatory(one, plan)["online is faster"] <= ALPHA for one in null_studies]
    assert np.mean(found) == pytest.approx(ALPHA, abs=0.01)


@pytest.mark.sim
def test_the_thesis_rules_find_something_in_nothing_far_more_often(null_studies):
    plan = Plan(rules="thesis")
    found = [min(confirmatory(one, plan).values()) <= ALPHA for one in null_studies[:400]]
    assert np.mean(found) > 0.2, "a workload thrice, and no adjustment"


@pytest.mark.sim
def test_more_people_find_an_effect_more_often():
    rng = np.random.default_rng(7)
    plan = Plan(hypotheses=THESIS_HYPOTHESES[1:2])
    power = [
        np.mean(
            [confirmatory(study(rng, people=n, online=1.15), plan)["online is faster"] <= ALPHA for _ in range(150)]
        )
        for n in (8, 16, 32)
    ]
    assert power[0] + 0.1 < power[1] < power[2] - 0.05
