"""`retouch study`: what is wrong is told in one line, and nothing is lost or half made."""

import pytest

from services.cli import main
from services.process.exit_codes import Exit


@pytest.fixture
def study(tmp_path, capsys):
    folder = tmp_path / "study"
    assert main(["study", "new", str(folder)]) == Exit.DONE
    capsys.readouterr()
    return folder


def said(capsys, *arguments):
    """Exit code, and what was said."""
    code = main(["study", *map(str, arguments)])
    out = capsys.readouterr()
    return code, out.out + out.err


def test_a_new_study_is_checked_and_frozen(study, capsys):
    code, text = said(capsys, "check", study)
    assert code == Exit.DONE
    assert "4 orders of 4 methods" in text
    assert "not frozen" in text
    assert said(capsys, "freeze", study)[0] == Exit.DONE
    assert "and as it was" in said(capsys, "check", study)[1]
    assert (study / "preregistration.md").exists()


def test_freezing_anew_is_said(study, capsys):
    said(capsys, "freeze", study)
    code, text = said(capsys, "freeze", study)
    assert code == Exit.DONE
    assert "frozen anew" in text


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("new", "{study}"), "is not empty"),
        (("check", "{study}/raw"), "there is no study in"),
        (("analyse", "{study}"), "nobody has taken part"),
        (("export", "{study}", "{study}"), "is not empty"),
    ],
)
def test_what_cannot_be_is_one_line_and_exit_code_2(study, capsys, arguments, told):
    code, text = said(capsys, *(one.format(study=study) for one in arguments))
    assert code == Exit.BAD_INPUT
    assert told in text
    assert "Traceback" not in text


def test_a_frozen_protocol_that_changed_is_told(study, capsys):
    said(capsys, "freeze", study)
    with (study / "protocol.toml").open("a", encoding="utf-8") as file:
        file.write("# changed\n")
    assert "changed since: protocol.toml" in said(capsys, "check", study)[1]


def test_a_questionnaire_that_is_not_there_is_told(study, capsys):
    path = study / "protocol.toml"
    path.write_text(path.read_text(encoding="utf-8").replace('"nasa_tlx"', '"nasa_txl"'), encoding="utf-8")
    code, text = said(capsys, "check", study)
    assert code == Exit.BAD_INPUT
    assert "did you mean nasa_tlx" in text
