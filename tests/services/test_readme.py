"""The README is true where a program can tell: its paths exist, its commands and exit codes are those of the code."""

import re
from pathlib import Path

import pytest

from services.commands.table import COMMANDS
from services.process.exit_codes import Exit

ROOT = Path(__file__).resolve().parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
ROOMS = ("deploy", "lfd", "protocol", "services", "sim", "tests")


def paths():
    """What stands in code style, or behind a link, and begins with a room."""
    named = re.findall(r"`([^`\s]+)[` ]", README) + re.findall(r"\]\(([^)]+)\)", README)
    return sorted({name for name in named if name.partition("/")[0] in ROOMS and "/" in name})


@pytest.mark.parametrize("path", paths())
def test_every_path_exists(path):
    assert (ROOT / path).exists()


def test_every_command_is_there():
    for command in COMMANDS:
        assert f"`retouch {command.name}" in README or f"`{command.name}`" in README, command.name


def test_every_exit_code_is_there():
    for code in set(Exit) - {Exit.TRY_AGAIN}:
        assert re.search(rf"[: ]{code.value} \w", README), code.name
