"""Tables as spreadsheets write them: whatever separates the cells, marks the decimals and encodes the letters."""

import csv
import io
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lfd.arrays import Array
from lfd.exceptions import TableError
from lfd.store.encodings import text_of

SHOWN = 40  # characters of a cell in an error

_SEPARATORS = {",": "commas", ";": "semicolons", "\t": "tabs", "|": "bars", " ": "spaces"}
_BEGINNING = 4096  # characters in which the first line is
_NUMBER = re.compile(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)
_GROUPED = re.compile(r"[+-]?\d{1,3}(([.,' ])\d{3})+([.,]\d+)?", re.ASCII)  # 1,234.5 or 1.234,5
_WITH_UNIT = re.compile(r"([+-]?[\d.,]+)\s*[^\W\d_]+", re.ASCII)  # 12 mm
_HEADING = re.compile(r"#?\s*(.*?)\s*(?:[\[(]\s*(.*?)\s*[\])])?")  # a name, and its unit in brackets


@dataclass(frozen=True)
class Row:
    """One line of a table.

    Attributes:
        path: Of the file.
        line: Its number, from 1.
        cells: By column, without the space around them.
    """

    path: Path
    line: int
    cells: dict[str, str]

    def number(self, column: str) -> float:
        """The number in a column, with a decimal point or a decimal comma.

        Raises:
            TableError: There is none, or it is not finite.
        """
        cell = self.cells[column]
        text = cell.replace("\N{MINUS SIGN}", "-")
        number = float(text.replace(",", ".")) if _NUMBER.fullmatch(text) else math.nan
        if not math.isfinite(number):
            raise self.error(_not_a_number(cell), column)
        return number

    def error(self, reason: str, column: str | None = None) -> TableError:
        """What is wrong with this line, or with one of its cells."""
        value = self.cells.get(column) if column is not None else None
        return TableError(self.path, reason, line=self.line, column=column, value=value)


@dataclass(frozen=True)
class Table:
    """What was asked for of a file.

    Attributes:
        columns: That are there, of those that were asked for.
        rows: In their order.
        others: Columns that are there and were not asked for.
    """

    columns: tuple[str, ...]
    rows: list[Row]
    others: tuple[str, ...] = ()

    def numbers(self, columns: Sequence[str]) -> Array:
        """The numbers of columns, shape (rows, columns).

        Raises:
            TableError: A cell holds none.
        """
        numbers = [[row.number(column) for column in columns] for row in self.rows]
        return np.array(numbers, dtype=np.float64).reshape(len(self.rows), len(columns))


def read_table(
    path: Path, units: Mapping[str, str], optional: Sequence[str] = (), largest_bytes: int = 1 << 20
) -> Table:
    """Read a file whose first line names its columns, in any order, among others or not.

    Empty rows and columns, lines that begin with #, byte order marks, capitals in names and units in brackets after
    them are understood. Only the columns that are asked for are kept.

    Args:
        path: The file.
        units: Of the columns that are asked for, by their names: the only ones that a heading may name; any, where one
            is empty.
        optional: Those of them that need not be there.
        largest_bytes: Of the file.

    Raises:
        TableError: It cannot be read, is too large or no text, its first line does not name the columns, or a line has
            more cells than that.
    """
    text = text_of(path, largest_bytes)
    separator = _separator(text, units)
    try:
        lines = list(_lines(text, separator))
    except csv.Error as error:
        raise TableError(path, f"not a table: {error}") from None
    if not lines:
        raise TableError(path, f"the file is empty: its first line has to be {_list(units, optional)}")
    names = _names(path, *lines[0], units, optional)
    for line, cells in lines[1:]:
        _check_length(path, line, cells, names, separator)
    asked = [(i, name) for i, name in enumerate(names) if name in units]
    rows = [
        Row(path, line, {name: cells[i] if i < len(cells) else "" for i, name in asked}) for line, cells in lines[1:]
    ]
    others = tuple(name for name in names if name and name not in units)
    return Table(tuple(name for name in units if name in names), rows, others)


def _check_length(path: Path, line: int, cells: list[str], names: list[str], separator: str) -> None:
    """Let a line of as many cells as there are names pass; empty ones at its end do not count.

    Raises:
        TableError: It has more, or holds all in one because another mark separates them.
    """
    count = f"{len(cells)} cell(s) under {len(names)} columns"
    if len(cells) > len(names):
        raise TableError(path, count + _why_more(cells, separator), line=line)
    other = next((name for mark, name in _SEPARATORS.items() if cells[0].count(mark) >= len(names) - 1 > 0), None)
    if len(cells) == 1 and other is not None:
        why = f"this line separates them by {other}, the first one by {_SEPARATORS[separator]}"
        raise TableError(path, f"{count}: {why}", line=line, value=cells[0])


def _separator(text: str, columns: Mapping[str, str]) -> str:
    """Which one divides the first line into most of the columns."""

    def found(separator: str) -> int:
        first = next(_lines(text[:_BEGINNING], separator), (0, []))[1]
        return sum(_HEADING.fullmatch(cell.casefold())[1] in columns for cell in first)  # type: ignore[index]  # matches any text

    return max(_SEPARATORS, key=found)


def _lines(text: str, separator: str) -> Iterator[tuple[int, list[str]]]:
    """Numbers and cells of the lines that hold any, without empty cells at their ends."""
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, skipinitialspace=True)
    named = False
    for row in reader:
        cells = [cell.strip() for cell in row]
        while cells and not cells[-1]:
            cells.pop()
        declares = not named and bool(cells) and cells[0].casefold().startswith("sep=")  # as Excel does
        remark = named and bool(cells) and cells[0].startswith("#")
        if cells and not declares and not remark:
            named = True
            yield reader.line_num, cells


def _names(path: Path, line: int, cells: list[str], units: Mapping[str, str], optional: Sequence[str]) -> list[str]:
    """The names in the first line, in lower case.

    Raises:
        TableError: A column is missing or there twice, or in another unit.
    """
    names = []
    for cell in cells:
        name, given = _HEADING.fullmatch(cell.casefold()).groups()  # type: ignore[union-attr]  # matches any text
        if given and units.get(name) and given != units[name]:
            raise TableError(path, f"column {name} is in {given!r}: give {units[name]}", line=line)
        names.append(name)
    missing = [name for name in units if name not in names and name not in optional]
    wanted = f"the first line has to be {_list(units, optional)}"
    if missing and all(_NUMBER.fullmatch(name) for name in names):
        raise TableError(path, f"no column {', '.join(missing)}: these are numbers, and {wanted}", line=line)
    if missing:
        raise TableError(path, f"no column {', '.join(missing)}; {wanted}", line=line)
    twice = [name for name in units if names.count(name) > 1]
    if twice:
        raise TableError(path, f"column {twice[0]} is there twice: leave one out", line=line)
    return names


def _list(units: Mapping[str, str], optional: Sequence[str]) -> str:
    needed = ",".join(name for name in units if name not in optional)
    return f"{needed}, and may name {','.join(optional)}" if optional else needed


def _not_a_number(cell: str) -> str:
    """What is wrong with a cell, and what would be right."""
    shown = repr(cell if len(cell) <= SHOWN else f"{cell[:SHOWN]}...")
    said = f"{shown} is not a number"
    if not cell:
        return f"{said}: the cell is empty, or the line has too few"
    if cell.casefold().lstrip("+-") in {"nan", "inf", "infinity", "#n/a", "n/a", "null", "none"}:
        return f"{said} that a motion can have: leave the line out, or repair it"
    if _GROUPED.fullmatch(cell):
        return f"{said}: write it without marks between the thousands"
    if _WITH_UNIT.fullmatch(cell):
        return f"{said}: write the number alone, its unit belongs into the first line"
    return said


def _why_more(cells: Sequence[str], separator: str) -> str:
    if separator != "," or not all(_NUMBER.fullmatch(cell) for cell in cells):
        return ": name the others in the first line, or leave them out"
    return (
        ": are these decimal commas in a file that separates its cells by commas?"
        " Write decimal points, or separate by semicolons"
    )
