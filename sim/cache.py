"""What takes long to make is made once and kept: in the user's cache folder, or in a temporary one."""

from __future__ import annotations

import contextlib
import logging
import os
import shutil
import stat
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

from sim.exceptions import CacheUnusable

log = logging.getLogger(__name__)

VARIABLE = "XDG_CACHE_HOME"


def kept(name: str, make: Callable[[Path, Path], None], cache: Path | None = None) -> Path:
    """Return what is kept under a name, making it at first use.

    It is safe to call from several processes at once: each builds in a folder of its own, and the first to finish
    moves it into place. Where the user's cache folder cannot be written, a temporary one is used, and said.

    Args:
        name: Of the file or folder; whoever changes what is made changes the name.
        make: Called with a path to make it at and the path where it will lie then.
        cache: Folder to keep it in, and no other; the user's by default.

    Raises:
        CacheUnusable: It cannot be kept anywhere.
    """
    folders = [cache.absolute()] if cache is not None else list(_folders())
    for folder in folders:
        if (folder / name).exists():
            return folder / name
    reason = "there is no home folder"
    for folder in folders:
        try:
            made = _made(folder, name, make)
        except OSError as error:
            reason = f"{folder}: {error.strerror or error}"
            continue
        if folder is not folders[0]:
            log.warning("the cache cannot be used (%s; it is set by %s): %s is kept instead", reason, VARIABLE, made)
        return made
    raise CacheUnusable(reason, VARIABLE)


def _folders() -> Iterator[Path]:
    """The user's cache folder by the XDG base directory specification, then a temporary one of the user's own."""
    configured = Path(os.environ.get(VARIABLE) or "")
    if configured.is_absolute():
        yield configured / "retouch"
    else:
        with contextlib.suppress(RuntimeError):  # there is no home
            yield Path.home() / ".cache" / "retouch"
    try:
        temporary = Path(tempfile.gettempdir()) / f"retouch-{os.getuid()}"
        temporary.mkdir(mode=0o700, exist_ok=True)
        found = temporary.lstat()
    except OSError:
        return
    # Everybody may write beside it: it has to be a folder, this user's, and nobody else's to write.
    if stat.S_ISDIR(found.st_mode) and found.st_uid == os.getuid() and not found.st_mode & 0o022:
        yield temporary


def _made(folder: Path, name: str, make: Callable[[Path, Path], None]) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    scratch = Path(tempfile.mkdtemp(prefix=f".{name}-", dir=folder))
    target = folder / name
    try:
        make(scratch / name, target)
        try:
            (scratch / name).replace(target)
        except OSError:
            if not target.exists():
                raise  # it was not another process that came first
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    return target
