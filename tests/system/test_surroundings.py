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


def test_other_projects_modules_are_not_run_in_the_processes_of_a_pool(tmp_path, foreign):
    arguments = ("reproduce", "factor-ten", "welford", "--people", "1", "--jobs", "2", "--out", tmp_path / "out")
    with Command(*arguments, folder=tmp_path, environment=foreign) as reproduce:
        assert reproduce.ended(START_S) == Exit.DONE, reproduce.tail()
    assert "foreign ran" not in reproduce.out + reproduce.err


@pytest.mark.parametrize(
    ("variable", "process"), [("XDG_DATA_HOME", "model"), ("XDG_STATE_HOME", "robot")], ids=["data", "state"]
)
@pytest.mark.parametrize("value", ["/dev/null", "relative"])
@pytest.mark.sim
def test_a_folder_that_cannot_be_ends_the_run_with_its_name_and_variable(tmp_path, variable, process, value):
    arguments = ("--headless", "--once", "--only", process, "--config", configured(tmp_path, free_endpoint()))
    with Command("up", *arguments, folder=tmp_path, environment={variable: value}) as up:
        assert up.ended(START_S) == Exit.ENVIRONMENT
    (line,) = up.err.splitlines()
    for word in (process, value, variable):
        assert word in line
    assert "starts again" not in up.out


def test_a_folder_of_runs_that_cannot_be_is_named_with_its_setting(tmp_path):
    (tmp_path / "runs").write_text("a file")
    arguments = ("--headless", "--only", "master", "--listen", free_endpoint())
    with Command("up", *arguments, folder=tmp_path) as up:
        assert up.ended(START_S) == Exit.ENVIRONMENT
    (line,) = up.err.splitlines()
    assert "runs" in line
    assert "[viewer] folder" in line


@pytest.mark.sim
@pytest.mark.parametrize("cache", [{"XDG_CACHE_HOME": "/dev/null"}, {"XDG_CACHE_HOME": "", "HOME": "/dev/null"}])
def test_a_cache_that_cannot_be_is_replaced_and_said(tmp_path, router, cache):
    (tmp_path / "tmp").mkdir()
    environment = {**cache, "TMPDIR": str(tmp_path / "tmp"), "PYOPENGL_PLATFORM": "osmesa", "MUJOCO_GL": "osmesa"}
    arguments = ("camera", "--connect", router)
    with Command(*arguments, folder=tmp_path, environment=environment) as camera, Witness(router) as witness:
        witness.next_beats({"camera"}, START_S)
        assert "XDG_CACHE_HOME" in camera.err
        assert "/dev/null" in camera.err


@pytest.mark.sim
def test_a_driver_that_another_project_chose_is_named(tmp_path, router):
    with Command("camera", "--connect", router, folder=tmp_path, environment={"GALLIUM_DRIVER": "none"}) as camera:
        assert camera.ended(START_S) == Exit.ENVIRONMENT
    assert "unset GALLIUM_DRIVER" in camera.err


@pytest.mark.parametrize("encoding", ["ascii", "latin-1"])
def test_a_terminal_of_another_alphabet_is_no_reason_to_fail(tmp_path, encoding):
    environment = {"LC_ALL": "C", "LANG": "C", "PYTHONIOENCODING": encoding, "TERM": "dumb", "COLUMNS": "20"}
    folder = tmp_path / "schüssel→"
    folder.mkdir()
    arguments = ("--only", "master", "--config", configured(folder, free_endpoint()), "--no-browser")
    with Command("up", *arguments, folder=folder, environment=environment) as up:
        up.until(lambda: "master | INFO started" in up.out, START_S, "the master has started")
        up.process.terminate()
        assert up.ended(10.0) == Exit.DONE
        assert "Traceback" not in up.out + up.err
