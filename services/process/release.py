"""Which release of this software runs here."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version


def release(package: str = "retouch") -> str:
    """As its package calls it, or another one's; empty where that is not installed."""
    try:
        return version(package)
    except PackageNotFoundError:
        return ""
