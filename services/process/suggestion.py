"""What who wrote a name meant, where there is nothing of that name."""

from __future__ import annotations

from collections.abc import Collection
from difflib import get_close_matches


def nearest(written: str, known: Collection[str], prefix: str = "") -> str:
    """The nearest name, as a question; empty where none is near.

    Args:
        written: by a person.
        known: names that there are.
        prefix: that the name is told with.
    """
    meant = get_close_matches(written, known, 1)
    return f"did you mean {prefix}{meant[0]}?" if meant else ""


def right(written: str, known: Collection[str]) -> str:
    """What would be right: the nearest name, or one of all where none is near."""
    return nearest(written, known) or f"one of {', '.join(known)}"
