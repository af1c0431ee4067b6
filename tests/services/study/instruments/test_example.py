"""The example of a questionnaire is one, and leaves no kind of question or score out."""

from pathlib import Path
from typing import get_args

import pytest

from services.study.instruments.library import load
from services.study.instruments.questions import Question
from services.study.instruments.scoring import Score
from services.study.protocol.protocol import load as load_protocol
from services.study.protocols import SHIPPED

EXAMPLE = Path(__file__).parents[4] / "deploy/examples/questionnaire.toml"


@pytest.fixture
def example(tmp_path):
    (tmp_path / "instruments").mkdir()
    (tmp_path / "instruments" / EXAMPLE.name).write_bytes(EXAMPLE.read_bytes())
    return load(tmp_path, EXAMPLE.stem, ("en", "de"), load_protocol(SHIPPED["thesis"]).methods)


def test_it_has_every_kind_of_question_and_score(example):
    assert {type(one) for one in example.questions} == set(get_args(Question))
    assert {type(one) for one in example.scores} == set(get_args(Score))


def test_its_scores_are_computed(example):
    answers = {"control": 7, "surprise": 1, "glasses": "no", "easiest": "OnKey", "hours": 7.5}
    answers |= {"control/surprise": "control"}
    example.check(answers)
    assert example.scored(answers) == {"trust": 100.0, "felt": 7.0}
