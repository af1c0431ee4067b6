"""Files that are written whole or not at all, and the folders where a user's files belong (XDG base directories)."""

from __future__ import annotations

import errno
import os
import tempfile
from pathlib import Path

from services.process.exceptions import CannotWrite, FolderUnusable


def write_whole(path: Path, content: bytes, mode: int = 0o644) -> None:
    """Write a file whole or not at all; when this returns it outlives a power cut.

    A link stays one: what it points to is written. What is no file, such as a device, is never replaced by one.

    Args:
        path: of the file.
        content: all of it.
        mode: who may read and write it.

    Raises:
        OSError: it cannot be written; what was there before is untouched.
    """
    path = path.resolve()
    if path.exists() and not path.is_file():
        raise OSError(errno.EINVAL, "Not a file", str(path))
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}-", suffix=".part")
    part = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
            file.flush()
            os.fchmod(file.fileno(), mode)
            os.fsync(file.fileno())
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
    settle_names(path.parent)


def write_file(path: Path, content: bytes) -> None:
    """Write a file that somebody asked for, its folder too where it is missing; see `write_whole`.

    Args:
        path: of the file.
        content: all of it.

    Raises:
        CannotWrite: it cannot be written.
    """
    try:
        make_folder(path.parent)
        write_whole(path, content)
    except OSError as error:
        raise CannotWrite(path, error.strerror or str(error)) from None


def settle_names(folder: Path) -> None:
    """Bring to the disk what the files of a folder are called: of a new file that is not yet so with its content.

    Raises:
        OSError: it cannot be brought there.
    """
    opened = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(opened)
    finally:
        os.close(opened)


def make_folder(folder: Path, mode: int = 0o777) -> None:
    """Make a folder, and those that it is in, where they are missing; when this returns they outlive a power cut.

    Args:
        folder: that is to be there.
        mode: who may use it, where it is made.

    Raises:
        OSError: it cannot be made.
    """
    if folder.is_dir():
        return
    if not folder.parent.is_dir():
        make_folder(folder.parent)
    folder.mkdir(mode=mode, exist_ok=True)
    settle_names(folder.parent)


def signature(path: Path) -> tuple[int, int, int] | None:
    """Changes with the file's content; None where there is none to be read."""
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_mtime_ns, found.st_size, found.st_ino


def data_folder() -> Path:
    """Where what was learnt belongs: `$XDG_DATA_HOME/retouch` or `~/.local/share/retouch`.

    Raises:
        FolderUnusable: it cannot be made or written.
    """
    return _folder("XDG_DATA_HOME", ".local/share")


def state_folder() -> Path:
    """Where what has to outlive the process belongs: `$XDG_STATE_HOME/retouch` or `~/.local/state/retouch`.

    Raises:
        FolderUnusable: it cannot be made or written.
    """
    return _folder("XDG_STATE_HOME", ".local/state")


def settings_folder() -> Path:
    """Where what a person has set belongs: `$XDG_CONFIG_HOME/retouch` or `~/.config/retouch`.

    Raises:
        FolderUnusable: it cannot be made or written.
    """
    return _folder("XDG_CONFIG_HOME", ".config")


def _folder(variable: str, under_home: str) -> Path:
    configured = os.environ.get(variable)
    if configured and not Path(configured).is_absolute():
        raise FolderUnusable(Path(configured), variable, "It is no absolute path")
    try:
        folder = (Path(configured) if configured else Path.home() / under_home) / "retouch"
    except RuntimeError:
        raise FolderUnusable(Path("~") / under_home, variable, "There is no home folder") from None
    try:
        make_folder(folder)
        usable = os.access(folder, os.W_OK | os.X_OK)
    except OSError as error:
        raise FolderUnusable(folder, variable, error.strerror or str(error)) from None
    if not usable:
        raise FolderUnusable(folder, variable, "Permission denied")
    return folder
