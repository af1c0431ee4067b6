"""Which release of this software runs here."""

from __future__ import annotations

import platform
from collections.abc import Sequence
from importlib.metadata import PackageNotFoundError, version


def release(package: str = "retouch") -> str:
    """As its package calls it, or another one's; empty where that is not installed."""
    try:
        return version(package)
    except PackageNotFoundError:
        return ""


def versions(packages: Sequence[str]) -> dict[str, str]:
    """Of Python, and of those of the packages that are installed, by name."""
    installed = {name: release(name) for name in packages}
    return {"python": platform.python_version(), **{name: found for name, found in installed.items() if found}}
