"""Freezing: what a study is going to do, and with what, as digests that any later change contradicts."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from pathlib import Path

import msgspec

from services.process.release import versions
from services.process.written import read

FILE = "frozen.json"

_SOFTWARE = ("retouch", "numpy", "scipy", "mujoco", "pin", "eclipse-zenoh")

_ANALYSIS = Path(__file__).parent / "analysis"


class Frozen(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a study was when it was frozen.

    Attributes:
        at: when, UTC, ISO 8601.
        files: of the study's folder, each with its digest.
        analysis: digest of the analysis' own code.
        software: versions, by name.
    """

    at: str
    files: dict[str, str]
    analysis: str
    software: dict[str, str]


def digest(path: Path) -> str:
    """SHA-256 of a file, in hexadecimal."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def software() -> dict[str, str]:
    """What runs here, by name."""
    return versions(_SOFTWARE)


def analysis() -> str:
    """Digest of the analysis' own code, whatever its name in the file system."""
    total = hashlib.sha256()
    for path in sorted(_ANALYSIS.rglob("*")):
        if path.suffix in {".py", ".jinja"}:
            total.update(path.relative_to(_ANALYSIS).as_posix().encode() + b"\0" + path.read_bytes())
    return total.hexdigest()


def frozen_now(files: Mapping[str, Path], at: str) -> Frozen:
    """The state of now.

    Args:
        files: that count, by the name that they are told with.
        at: when, UTC, ISO 8601.
    """
    return Frozen(at, {name: digest(path) for name, path in sorted(files.items())}, analysis(), software())


def load(folder: Path) -> Frozen | None:
    """What was frozen; None where nothing was.

    Raises:
        ConfigurationError: the file holds something else.
    """
    path = folder / FILE
    return read(path, Frozen, "frozen study") if path.exists() else None


def changed(before: Frozen, now: Frozen) -> dict[str, str]:
    """What is another now, with its digest or version; empty for one that is not there any more."""
    was = {**before.files, "the analysis": before.analysis, **before.software}
    is_ = {**now.files, "the analysis": now.analysis, **now.software}
    return {name: is_.get(name, "") for name in sorted(was.keys() | is_.keys()) if was.get(name) != is_.get(name)}
