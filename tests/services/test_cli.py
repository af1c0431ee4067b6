"""The command line: commands as data, one line for what is wrong, an exit code for its cause."""

import errno
import subprocess
import sys
import tomllib
from dataclasses import replace
from pathlib import Path

import pytest

from lfd.exceptions import StorageUnavailable
from services import cli
from services.commands.command import Command
from services.commands.table import COMMANDS
from services.process.exceptions import CommandFailed, PortInUse, RoomMissing
from services.process.exit_codes import Exit
from services.reproduction.exceptions import CannotKeep
from services.viewer.exceptions import WebFilesMissing
from sim.exceptions import DrawingLibraryMissing, UnknownScene

PROJECT = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text(encoding="utf-8"))["project"]
SLOW = ("rich", "msgspec.toml", "numpy", "zenoh", "scipy", "mujoco")


@pytest.fixture
def failing(monkeypatch):
    """A function that runs a command which fails by an error; the exit code."""

    class Failing:
        def __init__(self, error):
            self.error = error

        def add_arguments(self, parser):
            parser.add_argument("--debug", action="store_true")

        def run(self, arguments):
            raise self.error

    def run(error, *arguments):
        monkeypatch.setattr(Command, "action", lambda _: Failing(error))
        monkeypatch.setattr(cli, "COMMANDS", (replace(COMMANDS[0], name="fail"),))
        monkeypatch.setattr(cli, "die_with_parent", lambda _: None)
        return cli.main([*arguments, "fail"])

    return run


PORT = PortInUse("the page", "127.0.0.1", 80, "[station] port", "in use")


@pytest.mark.parametrize(
    ("error", "code"),
    [
        (CommandFailed("no"), Exit.BAD_INPUT),
        (UnknownScene("kitchen", ("table",)), Exit.BAD_INPUT),
        (PORT, Exit.ENVIRONMENT),
        (RoomMissing("robot", "mujoco"), Exit.ENVIRONMENT),
        (WebFilesMissing("its program is not installed"), Exit.ENVIRONMENT),
        (CannotKeep(Path("out"), "No space left on device"), Exit.ENVIRONMENT),
        (DrawingLibraryMissing("no"), Exit.ENVIRONMENT),
        (OSError(errno.ENOSPC, "No space left on device", "out.json"), Exit.ENVIRONMENT),
        (PermissionError(errno.EACCES, "Permission denied", "out.json"), Exit.ENVIRONMENT),
        (ValueError("two\nlines"), Exit.CRASHED),
        (KeyboardInterrupt(), Exit.INTERRUPTED),
    ],
)
def test_the_exit_code_tells_the_cause_and_the_line_is_one(failing, capsys, error, code):
    assert failing(error) == code
    said = capsys.readouterr().err
    assert said.count("\n") == (code is not Exit.INTERRUPTED)
    assert "Traceback" not in said


def test_a_supervisor_is_told_whether_waiting_may_help(failing):
    assert failing(PORT, "--supervised", "1") == Exit.TRY_AGAIN
    locked = StorageUnavailable(Path("model.sqlite"), "locked", "end what holds it", passes=True)
    assert failing(locked, "--supervised", "1") == Exit.TRY_AGAIN
    assert failing(locked) == Exit.ENVIRONMENT
    assert failing(RoomMissing("robot", "mujoco"), "--supervised", "1") == Exit.ENVIRONMENT


def test_a_file_that_has_no_place_is_named(failing, capsys):
    failing(OSError(errno.ENOSPC, "No space left on device", "out.json"))
    assert "out.json: no space left on device" in capsys.readouterr().err


def test_help_loads_nothing_that_takes_long():
    script = (
        f"import sys; from services.cli import parser; parser().format_help(); print(*set({SLOW}) & set(sys.modules))"
    )
    told = subprocess.run([sys.executable, "-I", "-c", script], capture_output=True, text=True, check=True)
    assert not set(told.stdout.split()) & set(SLOW)


def test_help_names_every_command(capsys):
    with pytest.raises(SystemExit):
        cli.main(["--help"])
    said = capsys.readouterr().out
    assert all(command.name in said and command.help.split()[0] in said for command in COMMANDS)


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command.name)
def test_every_command_has_a_module_that_says_its_flags_and_runs(command):
    action = command.action()
    assert callable(action.add_arguments)
    assert callable(action.run)


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command.name)
def test_what_a_command_says_to_install_is_there(command):
    assert (command.needs or command.name) in PROJECT["optional-dependencies"]


@pytest.mark.parametrize(
    ("written", "said"),
    [
        ("upp", "retouch: argument COMMAND: invalid choice: 'upp'; did you mean up? See 'retouch --help'"),
        (
            "stop --relase",
            "retouch stop: unrecognized arguments: --relase; did you mean --release? See 'retouch stop --help'",
        ),
        (
            "up --operater=anna",
            "retouch up: unrecognized arguments: --operater=anna; did you mean --operator? See 'retouch up --help'",
        ),
        ("up --scene tabel", "retouch: unknown scene 'tabel'; did you mean table?"),
        ("up --only robott", "retouch: --only: unknown process 'robott'; did you mean robot?"),
    ],
)
def test_what_is_written_nearly_right_gets_the_nearest_name(capsys, written, said):
    try:
        code = cli.main(written.split())
    except SystemExit as left:
        code = left.code
    assert code == Exit.BAD_INPUT
    assert capsys.readouterr().err == f"{said}\n"


def test_what_is_near_to_nothing_gets_all_that_there_is(capsys):
    assert cli.main(["up", "--only", "xyz"]) == Exit.BAD_INPUT
    assert "'xyz'; one of robot, camera" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        cli.main(["xyzzy"])
    assert "choose from" in capsys.readouterr().err


def test_an_unknown_flag_is_named_with_the_help_of_its_command(capsys):
    with pytest.raises(SystemExit) as left:
        cli.main(["robot", "--headless"])
    assert left.value.code == Exit.BAD_INPUT
    assert capsys.readouterr().err == "retouch robot: unrecognized arguments: --headless; see 'retouch robot --help'\n"


def test_a_name_of_thousands_of_characters_is_not_echoed_whole(capsys):
    with pytest.raises(SystemExit):
        cli.main(["robot", f"--{'x' * 3000}"])
    assert len(capsys.readouterr().err) < 400


def test_a_limit_of_the_machine_is_named(failing, capsys):
    assert failing(MemoryError()) == Exit.ENVIRONMENT
    assert "ulimit -v" in capsys.readouterr().err
