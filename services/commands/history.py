"""`retouch history`: what a running model has learnt, taken back and used again."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from rich.table import Table
from rich.text import Text

from protocol import queries
from protocol.messages import ModelState
from protocol.queries import Entry, HistoryListed, ListHistory, Redo, Undo
from services.bus.identity import new_number
from services.commands.arguments import add_network, whole
from services.commands.model_process import ModelProcess, model_process
from services.commands.settings import configuration as configured
from services.commands.terminal import Terminal
from services.process.exit_codes import Exit
from services.process.lines import readable, when
from services.station.page.entries import Row, rows_of

_ABOUT = """\
Lists what the running model of a robot has learnt, the newest first: what it was,
who gave it and when, and how far it led from what was predicted before. What is not
in use takes no part in predictions; it stays in the list, and can be used again.
"""

_EXAMPLES = """\
examples:
  retouch history                             all entries, the newest first
  retouch history --undo 7 --operator anna    takes entry 7 back; the list says that anna did
  retouch history --redo 7                    uses it again
  retouch history --robot garage --connect tls/192.0.2.1:7447
                                              of another robot

'retouch teach --undo' takes back the newest that is in use, whatever its number.
"""

NARROWEST = 100
"""Columns of a terminal in which a row stays a line; a pipe gets as many as it needs."""


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description, parser.epilog = _ABOUT, _EXAMPLES
    turn = parser.add_mutually_exclusive_group()
    turn.add_argument("--undo", type=whole(1), metavar="N", help="take entry N back, whatever came after it")
    turn.add_argument("--redo", type=whole(1), metavar="N", help="use entry N again that was taken back")
    add_network(parser)


def run(arguments: Namespace) -> int:
    """See `Action`."""
    settings = configured(arguments)
    with model_process(settings, "history") as model:
        if arguments.undo is not None:
            undo = Undo(entry=arguments.undo, operator=settings.operator, request=new_number())
            model.ask(queries.UNDO, undo, f"take entry {arguments.undo} back")
        elif arguments.redo is not None:
            redo = Redo(entry=arguments.redo, operator=settings.operator, request=new_number())
            model.ask(queries.REDO, redo, f"use entry {arguments.redo} again")
        show(model.state(), listed(model), Terminal(highlight=False))
    return Exit.DONE


def listed(model: ModelProcess) -> HistoryListed:
    """All of a history, however long it is; the model tells some hundred entries at once."""
    entries: list[Entry] = []
    while True:
        part = model.ask(queries.HISTORY, ListHistory(entries[-1].id if entries else 0), "tell its history")
        entries += part.entries
        if not part.older or not part.entries:
            return HistoryListed(part.version, tuple(entries))


def show(state: ModelState, history: HistoryListed, console: Terminal) -> None:
    """Print a history.

    Args:
        state: of the model.
        history: all of it.
        console: where to.
    """
    rows = rows_of(history)
    whose = f"{state.scene} with robot {state.robot_kind}"
    if not rows.rows:
        console.print(f"{whose}: nothing learnt yet", markup=False)
        return
    counted = f"version {rows.version}, {rows.in_use} of {len(rows.rows)} in use"
    console.print(f"{whose}: {counted}", markup=False, soft_wrap=True)
    console.print(
        rows_table(rows.rows), width=None if console.is_terminal else max(console.width, NARROWEST), crop=False
    )


def print_wide(console: Terminal, table: Table) -> None:
    """Print a table; into a pipe as wide as it has to be."""
    console.print(table, width=None if console.is_terminal else max(console.width, NARROWEST), crop=False)


def rows_table(rows: tuple[Row, ...]) -> Table:
    """Of entries, a line each."""
    table = Table(box=None, pad_edge=False)
    table.add_column("entry", justify="right")
    for heading in ("what", "who", "when", "from what was predicted", "in use"):
        table.add_column(heading)
    for row in rows:
        words = (str(row.id), _what(row), row.who or "-", when(row.at) or "-", _moved(row), _in_use(row))
        table.add_row(*(Text(readable(word)) for word in words), style="" if row.in_use else "dim")
    return table


def _what(row: Row) -> str:
    what = row.what.removesuffix(f" {row.id}")
    return ", ".join(word for word in (f"{what} {row.how}".strip(), row.believed) if word)


def _moved(row: Row) -> str:
    return row.moved or "-"


def _in_use(row: Row) -> str:
    if not row.turned:
        return "yes" if row.in_use else "no"
    return f"{'yes' if row.in_use else 'no'}: {row.turned}, {when(row.turned_at) or '-'}"
