"""A skill as one file that can be sent, and a skill of such a file."""

from __future__ import annotations

import sys
from pathlib import Path

from lfd.exceptions import StorageError, StorageUnavailable
from services.model.exceptions import NoSkillIn
from services.model.export import SUFFIX, exported, read_export
from services.model.shelf import Shelf
from services.process.exceptions import CommandFailed
from services.process.files import write_file


def export(shelf: Shelf, name: str, file: Path | None) -> None:
    """Write a skill into a file, which is there whole or not at all.

    Args:
        shelf: of the robot.
        name: of the skill.
        file: to write; called as the skill, in this folder, where none is named.

    Raises:
        SkillError: there is no such skill.
        StorageError: its file cannot be used.
        CommandFailed: there is such a file already.
        CannotWrite: it cannot be written.
    """
    path = file if file is not None else Path(f"{name}{SUFFIX}")
    with shelf.read(name) as store:
        whole = store.whole()
    content = exported(name, whole)
    if path.exists():
        raise CommandFailed(f"{path} is there already: name another file")
    write_file(path, content)
    _say(f"skill {name} is in {path}: {len(whole.records)} entries, {len(content) / 1e6:.2f} MB")


def bring_in(shelf: Shelf, file: Path, name: str | None) -> None:
    """Make a skill of an exported file; one that is there is never touched.

    Args:
        shelf: of the robot.
        file: that was exported.
        name: of the new skill; as it was called where it was exported, where none is given.

    Raises:
        ExportUnusable: the file is no export, or is not as it was written.
        SkillError: there is a skill of the name already, or none can be called so.
        StorageError: it cannot be written.
    """
    content = read_export(file)
    called = content.name if name is None else name
    try:
        shelf.put(called, lambda store: store.restore(content.whole))
    except StorageUnavailable:
        raise
    except StorageError as error:
        raise NoSkillIn(file, error.reason) from None
    where = f"task {content.task} on {content.robot_kind or 'any robot'}"
    _say(f"skill {called} is there, for {where}, with {len(content.demonstrations)} entries")


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
