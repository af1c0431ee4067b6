"""What the cells of a table of observations say, each with an error that names its line and column."""

from __future__ import annotations

import math
from dataclasses import dataclass

from lfd.exceptions import TableError
from lfd.store.spreadsheet import Row

_NOTHING = frozenset(("", "na", "n/a", "#n/a", "nan", "none", "null", "-", "–", "."))
_YES = frozenset(("yes", "y", "true", "1", "1.0", "ja", "wahr", "waar"))
_NO = frozenset(("no", "n", "false", "0", "0.0", "nein", "nee", "falsch", "onwaar"))


@dataclass(frozen=True)
class Cells:
    """A line of the table, by our names of its columns.

    Attributes:
        row: as it was read.
        theirs: the table's names of the columns that are there, by ours.
    """

    row: Row
    theirs: dict[str, str]

    def text(self, column: str) -> str:
        """What it says; empty where it says nothing, or is not there."""
        cell = self.row.cells[self.theirs[column]] if column in self.theirs else ""
        return "" if cell.casefold() in _NOTHING else cell

    def name(self, column: str) -> str:
        """A text that must not be empty.

        Raises:
            TableError: it is.
        """
        text = self.text(column)
        if not text:
            raise self.wrong(column, f"it is empty: every line needs a {column}")
        return text

    def number(
        self, column: str, low: float = -math.inf, high: float = math.inf, *, above: bool = False
    ) -> float | None:
        """A number within bounds; None where the cell says nothing.

        Args:
            column: ours.
            low: the smallest one.
            high: the largest one.
            above: whether `low` itself is too small.

        Raises:
            TableError: there is something else.
        """
        if not self.text(column):
            return None
        value = self.row.number(self.theirs[column])
        if not low <= value <= high or (above and value == low):
            upper = f" to {high:g}" if math.isfinite(high) else ""
            bounds = f"above {low:g}" if above else f"from {low:g}{upper}" if upper else f"at least {low:g}"
            raise self.wrong(column, f"{value:g} is out of range: it has to be {bounds}")
        return value

    def whole(self, column: str, low: int) -> int | None:
        """A whole number that is not smaller; None where the cell says nothing.

        Raises:
            TableError: there is something else.
        """
        value = self.number(column, low)
        if value is not None and not value.is_integer():
            raise self.wrong(column, f"{value:g} is no whole number")
        return None if value is None else int(value)

    def flag(self, column: str) -> bool | None:
        """A yes or no; None where the cell says neither.

        Raises:
            TableError: there is something else.
        """
        text = self.text(column)
        if text.casefold() in _YES:
            return True
        if text.casefold() in _NO:
            return False
        if text:
            raise self.wrong(column, f"{text!r} is neither yes nor no: write yes, no, true, false, 1 or 0")
        return None

    def wrong(self, column: str, reason: str) -> TableError:
        """What is wrong with a cell."""
        return self.row.error(reason, self.theirs.get(column, column))
