"""`retouch replay FILE`: a recording in Rerun's own window."""

from __future__ import annotations

import contextlib
import logging
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from services.viewer.exceptions import CannotReplay, WebFilesMissing
from services.viewer.framing import whole_length
from services.viewer.web_files import sdk_program

log = logging.getLogger(__name__)

_MAGIC = b"RRF"
_FRAMED = b"RRF2"
"""Older ones are framed in other ways."""
_LONGEST_REASON = 300


def replay(path: Path) -> None:
    """Open the recording in the native viewer; returns when its window is closed.

    Raises:
        CannotReplay: there is no such file, it is no recording, or the window cannot be opened.
    """
    _check(path)
    if sys.platform.startswith("linux") and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise CannotReplay(path, "there is no display; open the file where there is one, with: rerun FILE")
    try:
        program = sdk_program()
    except WebFilesMissing as error:
        raise CannotReplay(path, error.reason + "; reinstall rerun-sdk") from None
    with _whole(path) as file:
        ended = subprocess.run(
            [str(program), str(file)],
            env={**os.environ, "RERUN_ANALYTICS": "0"},
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    if ended.returncode > 0:
        said = [line for line in ended.stderr.splitlines() if line.strip()]
        raise CannotReplay(path, (said[-1] if said else f"rerun ended with {ended.returncode}")[:_LONGEST_REASON])


@contextlib.contextmanager
def _whole(path: Path) -> Iterator[Path]:
    """The recording, or a copy without what follows the last whole message, where it broke off within one."""
    with path.open("rb") as file:
        framed = file.read(len(_FRAMED)) == _FRAMED
    size = path.stat().st_size
    length = whole_length(path) if framed else size
    broken = size - length
    if not broken:
        yield path
        return
    log.warning("%s breaks off: its last %d bytes are not shown", path, broken)
    with tempfile.TemporaryDirectory() as folder:
        copied = Path(folder) / path.name
        try:
            shutil.copyfile(path, copied)
            os.truncate(copied, length)
        except OSError as error:
            raise CannotReplay(path, f"it breaks off, and cannot be copied: {error.strerror}") from None
        yield copied


def _check(path: Path) -> None:
    try:
        with path.open("rb") as file:
            magic = file.read(len(_MAGIC))
    except OSError as error:
        raise CannotReplay(path, f"{error.strerror}; recordings lie in the folder [viewer] folder") from None
    if magic != _MAGIC:
        raise CannotReplay(path, "it is not a Rerun recording (.rrd)")
