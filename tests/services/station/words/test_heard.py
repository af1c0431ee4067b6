"""What other processes say is found in the table by its English words, so that another language has it too."""

import ast
from pathlib import Path
from string import Formatter

import pytest

from services.station.words.heard import heard
from services.station.words.table import speech

SERVICES = Path(__file__).parents[4] / "services"
SAY = ("Refusal", "Refused", "Failed")
FACT = "4.2"


@pytest.fixture
def german():
    speech.speak("de")
    yield
    speech.speak("en")


def said():
    """Every sentence with which the robot, the model or the bus refuses, each fact in it a number."""
    for file in (file for room in ("robot", "model", "bus") for file in (SERVICES / room).rglob("*.py")):
        for call in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id in SAY and call.args:
                words = sentence(call.args[0])
                if words is not None:
                    yield words


def sentence(node):
    """Of a text in the source; None of one that is made elsewhere."""
    if isinstance(node, ast.Constant):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(part.value if isinstance(part, ast.Constant) else FACT for part in node.values)
    return None


@pytest.mark.usefixtures("german")
def test_every_sentence_with_which_a_process_refuses_is_in_the_table():
    sentences = list(said())
    assert len(sentences) > 30
    assert [words for words in sentences if heard(words) == words] == []


@pytest.mark.usefixtures("german")
def test_what_a_sentence_holds_is_put_into_the_language_as_well():
    reason = "emergency stop by ann: it smokes: release it first"
    assert heard(reason) == "Notstopp von ann: it smokes: zuerst freigeben"
    assert heard("finished by ann at 12%") == "beendet von ann bei 12%"
    assert heard("there is no update to take back") == "nichts zurückzunehmen: keine Korrektur"


@pytest.mark.usefixtures("german")
@pytest.mark.parametrize("unknown", ["", "something else", "x" * 5000, "{who} (.+)"])
def test_what_the_table_has_not_got_stays_as_it_came(unknown):
    assert heard(unknown) == unknown


def test_in_english_everything_stays_as_it_came():
    assert [heard(words) for words in said()] == list(said())


def test_few_facts_stand_in_a_sentence():
    """So that a long sentence of a stranger keeps nobody waiting."""
    for words in speech.section("heard").values():
        assert sum(fact is not None for _, fact, _, _ in Formatter().parse(words)) <= 3
