"""`retouch study`: what is wrong is told in one line, and nothing is lost or half made."""

import datetime
import socket

import pytest

from services.cli import main
from services.process.exit_codes import Exit
from services.study.journal import Journal


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


def test_what_a_new_study_hints_at_leaves_it_to_people(tmp_path, capsys):
    folder = tmp_path / "mine"
    code, text = said(capsys, "new", folder)
    assert code == Exit.DONE
    (rehearsal,) = [line.split()[3] for line in text.splitlines() if "--synthetic" in line]
    assert rehearsal != str(folder)
    assert f"cp -r {folder} {rehearsal} " in text


def test_a_new_study_is_checked_and_frozen(study, capsys):
    code, text = said(capsys, "check", study)
    assert code == Exit.DONE
    assert "4 orders of 4 methods" in text
    assert "not frozen" in text
    assert said(capsys, "freeze", study)[0] == Exit.DONE
    assert "and as it was" in said(capsys, "check", study)[1]
    assert (study / "preregistration.md").exists()


@pytest.fixture
def taken():
    """A port where somebody listens."""
    with socket.create_server(("127.0.0.1", 0)) as listening:
        yield listening.getsockname()[1]


def utc():
    return datetime.datetime(2026, 1, 1, tzinfo=datetime.UTC)


def test_a_study_that_is_open_elsewhere_is_told_before_its_port(study, taken, capsys):
    with Journal(study / "raw", utc):
        code, text = said(capsys, "run", study, "--port", taken, "--no-browser")
    assert code == Exit.ENVIRONMENT
    assert "is open elsewhere" in text
    assert str(taken) not in text


def test_a_port_that_is_taken_is_another_flag_and_no_configuration(study, taken, capsys):
    code, text = said(capsys, "run", study, "--port", taken, "--no-browser")
    assert code == Exit.ENVIRONMENT
    assert "with --port" in text
    assert "configuration" not in text


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
