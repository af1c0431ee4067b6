"""A new task file, to be changed into a person's own."""

from __future__ import annotations

import sys
from pathlib import Path

from services.process.config import ROBOT_SUFFIX
from services.process.exceptions import UnusableSetting
from services.process.exit_codes import Exit
from services.process.files import write_file

EXAMPLE = Path(__file__).parent / "example.toml"


def new(which: str) -> int:
    """Write the example.

    Raises:
        UnusableSetting: no file is named, or something is there.
        CannotWrite: it cannot be written.
    """
    path = Path(which)
    if not which.endswith(ROBOT_SUFFIX):
        raise UnusableSetting("retouch task new", f"name the file, such as mine{ROBOT_SUFFIX}, not {which!r}")
    if path.exists():
        raise UnusableSetting(f"retouch task new {which}", "it is there already: name another, or remove it")
    name = "".join(c if c.isascii() and (c.isalnum() or c in "-_") else "-" for c in path.stem.lower())[:30]
    text = EXAMPLE.read_text(encoding="utf-8").replace('name = "mine"', f'name = "{name.lstrip("-_") or "mine"}"', 1)
    write_file(path, text.encode())
    sys.stdout.write(f"written: {path}\n")
    return Exit.DONE
