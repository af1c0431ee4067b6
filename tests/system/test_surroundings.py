"""Where it is started, and what other projects have set there, changes nothing."""

import signal

import pytest

from services.process.exit_codes import Exit
from tests.system.harness import START_S, Command, Witness, configured, free_endpoint

pytestmark = [pytest.mark.system, pytest.mark.zenoh]

FOREIGN = ("services", "sim", "lfd", "protocol", "sitecustomize", "usercustomize", "zenoh", "msgspec")
ELSEWHERE = {
    "PYTHONHOME": "/nonexistent",
    "PYTHONWARNINGS": "error",
    "PYTHONOPTIMIZE": "2",
    "PYTHONIOENCODING": "ascii",
    "PYTHONINSPECT": "1",
}


@pytest.fixture
def foreign(tmp_path):
    """A folder with packages of the product's names, which end whoever imports them; the variables that name it."""
    for name in FOREIGN:
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text("import os\nos.write(1, b'foreign ran')\nos._exit(66)\n")
    startup = tmp_path / "sitecustomize" / "__init__.py"
    return {**ELSEWHERE, "PYTHONPATH": str(tmp_path), "PYTHONSTARTUP": str(startup)}


@pytest.mark.sim
def test_other_projects_modules_are_not_run(tmp_path, foreign):
    endpoint = free_endpoint()
    configuration = configured(tmp_path, endpoint)
    names = {"robot", "model", "master", "perception"}
    arguments = ("--no-browser", "--only", ",".join(names), "--config", configuration)
    with Command("up", *arguments, folder=tmp_path, environment=foreign) as up, Witness(endpoint) as witness:
        witness.next_beats(names, START_S)
        up.process.send_signal(signal.SIGINT)
        assert up.ended(10.0) == Exit.DONE
    assert "foreign ran" not in up.out + up.err
    assert "starts again" not in up.out


@pytest.mark.parametrize("encoding", ["ascii", "latin-1"])
def test_a_terminal_of_another_alphabet_is_no_reason_to_fail(tmp_path, encoding):
    environment = {"LC_ALL": "C", "LANG": "C", "PYTHONIOENCODING": encoding, "TERM": "dumb", "COLUMNS": "20"}
    endpoint = free_endpoint()
    arguments = ("--only", "master", "--config", configured(tmp_path, endpoint), "--scene", "schüssel→")
    with Command("up", *arguments, "--no-browser", folder=tmp_path, environment=environment) as up:
        up.until(lambda: "master | INFO started" in up.out, START_S, "the master has started")
        up.process.terminate()
        assert up.ended(10.0) == Exit.DONE
        assert "Traceback" not in up.out + up.err
