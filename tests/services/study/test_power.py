"""Power grows with people and effect, is the error rate where there is none, and is the same from the same seed."""

import pytest

from services.study.protocol.protocol import load
from services.study.protocols import SHIPPED
from services.study.synthetic.power import Cell, Question, power

PROTOCOL = load(SHIPPED["thesis"])
ONLINE = "Refinement time: online against offline"


@pytest.fixture(scope="module")
def found():
    return power(Question(PROTOCOL, (8, 24), (0.0, 0.25), studies=120, seed=4))


def shown(found, people, effect):
    one = found[Cell(people, effect, ONLINE)]
    return one.successes / one.trials


@pytest.mark.sim
def test_more_people_and_larger_effects_are_shown_more_often(found):
    assert shown(found, 24, 0.25) > shown(found, 8, 0.25) + 0.2
    assert shown(found, 24, 0.25) > shown(found, 24, 0.0) + 0.5


@pytest.mark.sim
def test_without_an_effect_few_studies_show_one(found):
    for cell, one in found.items():
        if cell.effect == 0.0:
            assert one.interval[0] <= 0.05


@pytest.mark.sim
def test_the_same_seed_gives_the_same_figures_however_it_is_shared_out():
    question = Question(PROTOCOL, (8,), (0.2,), studies=60, seed=9)
    assert power(question, jobs=1) == power(question, jobs=2)
