"""What the page shows, by name: a text, or an attribute by which the style sheet tells how something looks.

A name is an element's `data-value`; with "@" an attribute of it follows, which True sets empty and False takes away, or
a style property that begins with "--".
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Generic, TypeVar

V = TypeVar("V")

Values = Mapping[str, str | bool]


class Sent(Generic[V]):
    """What a tab has been sent, by name: it is told only what is new to it."""

    def __init__(self) -> None:
        self._values: dict[str, V] = {}

    def news(self, values: Mapping[str, V]) -> Mapping[str, V]:
        """The values that the tab does not show yet; from now on it does."""
        told = self._values
        news = {
            name: value
            for name, value in values.items()
            if name not in told or (told[name] is not value and told[name] != value)
        }
        self._values.update(news)
        return news
