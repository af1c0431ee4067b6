"""What all pages look like: colours, type, symbols."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

FOLDER = Path(__file__).parent


def joined(sheets: Sequence[str], folder: Path) -> str:
    """Style sheets as one: what comes later counts more.

    Args:
        sheets: their names, each of this folder or of the page's own.
        folder: of the page's own.
    """
    found = (
        (where / f"{name}.css" for where in (folder, FOLDER) if (where / f"{name}.css").exists()) for name in sheets
    )
    return "\n".join(next(paths).read_text(encoding="utf-8") for paths in found)
