"""Tables of rows about a hypothesis each, whose name has a line of its own: they fit a narrow terminal."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rich.console import Console
from rich.text import Text

_BETWEEN = "  "


def show(console: Console, heads: Sequence[str], groups: Mapping[str, Sequence[Sequence[str | Text]]]) -> None:
    """Print columns to the right below their heads, each group below its name.

    Args:
        console: to print on.
        heads: of the columns.
        groups: of rows, by name; each row has as many cells as there are heads.
    """
    rows = [[cell if isinstance(cell, Text) else Text(cell) for cell in row] for of in groups.values() for row in of]
    widths = [max(map(len, column)) for column in zip([Text(head) for head in heads], *rows, strict=True)]
    console.print(_line([Text(head, style="bold") for head in heads], widths), soft_wrap=True)
    left = iter(rows)
    for name, of in groups.items():
        console.print(Text(name), soft_wrap=True)
        for _ in of:
            console.print(_line(next(left), widths), soft_wrap=True)


def _line(cells: Sequence[Text], widths: Sequence[int]) -> Text:
    padded = (Text(" " * (width - len(cell))) + cell for cell, width in zip(cells, widths, strict=True))
    return Text.assemble(*(part for cell in padded for part in (_BETWEEN, cell)))
