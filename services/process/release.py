"""Which release of this software runs here."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version


def release() -> str:
    """As its package calls it; empty where it is not installed as one."""
    try:
        return version("retouch")
    except PackageNotFoundError:
        return ""
