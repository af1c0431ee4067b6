"""Tables as spreadsheets write them: whatever separates the cells, marks the decimals and encodes the letters."""

import csv
import io
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from lfd.exceptions import TableError

LARGEST = 1 << 20  # [byte] of a table that a person wrote down
SHOWN = 40  # characters of a cell in an error

_SEPARATORS = (",", ";", "\t", "|", " ")
_BEGINNING = 4096  # characters in which the first line is
_NUMBER = re.compile(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)
_HEADING = re.compile(r"#?\s*(.*?)\s*(?:[\[(]\s*(.*?)\s*[\])])?")  # a name, and its unit in brackets
_MARKS = {b"\xef\xbb\xbf": "utf-8-sig", b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16"}


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
            shown = cell if len(cell) <= SHOWN else f"{cell[:SHOWN]}..."
            raise TableError(self.path, f"line {self.line}, column {column}: {shown!r} is not a number")
        return number


def read_table(path: Path, columns: Sequence[str], unit: str) -> list[Row]:
    """Read a file whose first line names its columns, in any order, among others or not.

    Empty rows and columns, lines that begin with #, byte order marks, capitals in names and units in brackets after
    them are understood. Only the columns that are asked for are kept.

    Args:
        path: The file.
        columns: That are asked for.
        unit: The only one that a heading may name.

    Raises:
        TableError: It cannot be read, is too large or no text, its first line does not name the columns, or a line has
            more cells than there are columns.
    """
    text = _text(path)
    separator = _separator(text, columns)
    try:
        lines = list(_lines(text, separator))
    except csv.Error as error:
        raise TableError(path, f"not a table: {error}") from None
    names = _names(path, lines[0][1] if lines else [], columns, unit)
    for line, cells in lines[1:]:
        if len(cells) > len(names):
            raise TableError(path, f"line {line}: {len(cells)} cells under {len(names)} columns{_why(separator)}")
    return [
        Row(path, line, {name: cells[i] if i < len(cells) else "" for i, name in enumerate(names) if name in columns})
        for line, cells in lines[1:]
    ]


def _text(path: Path) -> str:
    try:
        with path.open("rb") as file:
            content = file.read(LARGEST + 1)
    except OSError as error:
        raise TableError(path, error.strerror or str(error)) from None
    if len(content) > LARGEST:
        raise TableError(path, f"larger than {LARGEST >> 20} MiB: nobody wrote that down by hand")
    encoding = next((name for mark, name in _MARKS.items() if content.startswith(mark)), "utf-8")
    if encoding == "utf-8" and b"\0" in content[:4]:  # UTF-16 without its mark
        encoding = "utf-16-be" if content.startswith(b"\0") else "utf-16-le"
    try:
        return content.decode(encoding)
    except UnicodeDecodeError:
        pass
    text = content.decode("latin-1")
    # A note in an old encoding is text all the same; what is no text has other control characters than these.
    if any(ord(letter) < 32 and letter not in "\t\r\n" for letter in text) or encoding != "utf-8":
        raise TableError(path, "not a table: it is no text")
    return text


def _separator(text: str, columns: Sequence[str]) -> str:
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


def _names(path: Path, cells: list[str], columns: Sequence[str], unit: str) -> list[str]:
    """The names in the first line, in lower case.

    Raises:
        TableError: A column is missing or there twice, or in another unit.
    """
    names = []
    for cell in cells:
        name, given = _HEADING.fullmatch(cell.casefold()).groups()  # type: ignore[union-attr]  # matches any text
        if name in columns and given and given != unit:
            raise TableError(path, f"column {name} is in {given!r}: give {unit}")
        names.append(name)
    missing = [name for name in columns if name not in names]
    if missing:
        raise TableError(path, f"no column {', '.join(missing)}; the first line has to be {','.join(columns)}")
    twice = [name for name in columns if names.count(name) > 1]
    if twice:
        raise TableError(path, f"column {twice[0]} is there twice: leave one out")
    return names


def _why(separator: str) -> str:
    if separator != ",":
        return ""
    return (
        ": are these decimal commas in a file that separates its cells by commas?"
        " Write decimal points, or separate by semicolons"
    )
