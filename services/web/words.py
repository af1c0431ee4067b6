"""Tables of words: a file a language, sections of words by their names."""

from __future__ import annotations

import re
from pathlib import Path

import msgspec

_Table = dict[str, dict[str, str]]


def read(file: Path) -> dict[str, str]:
    """The words of a table, by section and name.

    Args:
        file: TOML.
    """
    table = msgspec.toml.decode(file.read_bytes(), type=_Table)
    return {f"{section}.{name}": spaced(words) for section, named in table.items() for name, words in named.items()}


def spaced(words: str) -> str:
    """Words in one line, however they are broken in the table."""
    return re.sub(r"\n\s*", " ", words.strip("\n"))
