"""`retouch reproduce`: makes the thesis' analyses again and writes one report."""

from __future__ import annotations

import math
import os
from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from services.commands.arguments import add_debug, whole
from services.commands.terminal import Terminal
from services.process.exit_codes import Exit
from services.process.runner import interruptible
from services.reproduction.analyses import ANALYSES
from services.reproduction.analysis import Analysis
from services.reproduction.exceptions import UnknownAnalysis
from services.reproduction.report import Entry, counts, write_report
from services.reproduction.store import Done, Failed, Record, Run, Store, code_key
from services.reproduction.summary import Holds
from services.reproduction.work import Piece, carry_out, pieces_of

_PEOPLE = 20
_STYLES = {Holds.YES: "green", Holds.NO: "red", Holds.UNDECIDED: "yellow"}

_ABOUT = """\
Makes the thesis' analyses again, with its model, with its model given the
start anchor and the resolution of the default model, with a DMP and with the
default model, and writes one HTML report. Each analysis states what the thesis
and Retouch claim as conditions on its figures, and says which hold.

Where a simulated person takes part, --people of them do, each with a seed of
their own: one takes ten minutes of a core, 20 three hours, which all cores
share; how long is said at the beginning. What is done is kept, run by run, and done again only where the code
has changed: after Ctrl-C the same command goes on.

A claim that does not hold is a result, not a failure: the summary counts and
the report lists them, and the exit code is 0. It is 1 where a run failed.
"""


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = _ABOUT
    parser.add_argument("names", nargs="*", metavar="NAME", help="of analyses (default: all)")
    parser.add_argument("--list", action="store_true", help="name the analyses and end")
    parser.add_argument(
        "--out", type=Path, metavar="FOLDER", default=Path("reproduction"), help="default: ./reproduction"
    )
    parser.add_argument("--fresh", action="store_true", help="do again what is done already")
    parser.add_argument(
        "--people", type=whole(1), metavar="N", default=_PEOPLE, help=f"that take part (default: {_PEOPLE})"
    )
    parser.add_argument("--seed", type=whole(0), metavar="N", default=0, help="of the first of them (default: 0)")
    parser.add_argument("--jobs", type=whole(1), metavar="N", help="processes (default: one a core)")
    add_debug(parser)


def run(arguments: Namespace) -> int:
    """See `Action`."""
    if arguments.list:
        show_list()
        return 0
    with interruptible():
        return reproduce(Request.from_arguments(arguments))


@dataclass(frozen=True)
class Request:
    """What to reproduce.

    Attributes:
        names: of the analyses; all where there is none.
        out: folder of the report and of what is kept.
        fresh: do what has been done already once more.
        people: that take part.
        seed: of the first of them.
        jobs: processes; one a core by default.
    """

    names: tuple[str, ...]
    out: Path
    fresh: bool
    people: int
    seed: int
    jobs: int | None

    @classmethod
    def from_arguments(cls, arguments: Namespace) -> Self:
        """Of the command's flags."""
        return cls(
            tuple(arguments.names),
            arguments.out,
            arguments.fresh,
            arguments.people,
            arguments.seed,
            arguments.jobs,
        )


def reproduce(request: Request, analyses: Sequence[Analysis] = ANALYSES) -> int:
    """Carry out what is asked for and not kept yet, and write the report.

    Args:
        request: what to do.
        analyses: all there are.

    Returns:
        The exit code: 0, or 1 where a run failed.

    Raises:
        UnknownAnalysis: a name is none's.
        CannotKeep: the folder cannot be written.
    """
    chosen = choose(request.names, analyses)
    seeds = range(request.seed, request.seed + request.people)
    jobs = request.jobs or os.cpu_count() or 1
    store = Store(request.out, code_key())
    asked = [piece for analysis in chosen for piece in pieces_of(analysis, seeds)]
    runs = {piece.run for piece in asked}
    records: dict[Run, Record] = {}
    for analysis in analyses:
        for _, one in pieces_of(analysis, seeds):
            kept = store.read(one)
            if kept is not None and not (one in runs and (request.fresh or isinstance(kept, Failed))):
                records[one] = kept
    todo = [piece for piece in asked if piece.run not in records]
    console = Terminal(stderr=True, highlight=False)

    def reported() -> list[Entry]:
        return [Entry.of(analysis, records, seeds) for analysis in analyses]

    report = write_report(request.out, reported(), seeds)
    _announce(console, asked, todo, jobs)
    try:
        with _Bar(console, todo) as bar:
            for piece, record in carry_out(todo, store, jobs, bar):
                records[piece.run] = record
                # Whoever interrupts it has two seconds: what is there by then has been written before.
                if bar.ended(piece, record, Entry.of(piece.analysis, records, seeds)):
                    write_report(request.out, reported(), seeds)
    except KeyboardInterrupt:
        left = sum(piece.run not in records for piece in todo)
        console.print(
            f"interrupted with {_runs(left)} to go; the same command goes on; so far: {report}", soft_wrap=True
        )
        raise
    found = [Entry.of(analysis, records, seeds) for analysis in chosen]
    failed = sum(entry.failed for entry in found)
    console.print(_summary(found, len(asked) - len(todo), failed), soft_wrap=True)
    Terminal(highlight=False, soft_wrap=True).print(str(report.resolve()), markup=False)
    return Exit.CRASHED if failed else Exit.DONE


def choose(names: Sequence[str], analyses: Sequence[Analysis]) -> list[Analysis]:
    """The analyses of those names, all where no name is given, in the order of the report.

    Raises:
        UnknownAnalysis: a name is none's.
    """
    known = [a.name for a in analyses]
    for name in names:
        if name not in known:
            raise UnknownAnalysis(name, known)
    return [a for a in analyses if not names or a.name in names]


def show_list(analyses: Sequence[Analysis] = ANALYSES) -> None:
    """Print every analysis with its place in the thesis."""
    names, references = (
        max(map(len, column)) for column in zip(*((a.name, a.reference) for a in analyses), strict=True)
    )
    for analysis in analyses:
        line = f"{analysis.name:<{names}}  {analysis.reference:<{references}}  {analysis.about}"
        Terminal(highlight=False, soft_wrap=True).print(line, markup=False)


def estimated(todo: Sequence[Piece], jobs: int) -> float:
    """How long runs take, roughly [s].

    Args:
        todo: the runs.
        jobs: processes.
    """
    seconds = [piece.analysis.seconds for piece in todo]
    return max(sum(seconds) / min(jobs, len(seconds)), *seconds) if seconds else 0.0


def _announce(console: Console, asked: Sequence[Piece], todo: Sequence[Piece], jobs: int) -> None:
    minutes = max(1, math.ceil(estimated(todo, jobs) / 60.0))
    time = f"{minutes} min" if minutes < 90 else f"{minutes / 60.0:.1f} h"
    kept = len(asked) - len(todo)
    said = f"{_runs(len(todo))} to make" + (f", {kept} kept from before" if kept else "")
    console.print(f"{said}; about {time} on {jobs} idle core{'s' * (jobs > 1)}" if todo else said, soft_wrap=True)


def _runs(count: int) -> str:
    return f"{count} run{'s' * (count != 1)}"


def _summary(found: Sequence[Entry], kept: int, failed: int) -> str:
    """What came out, in a line."""
    holds, not_, undecided = (counts(found, one) for one in (Holds.YES, Holds.NO, Holds.UNDECIDED))
    said = f"claims that hold: {holds}, that do not: {not_}"
    said += f", undecided: {undecided}, which more --people may decide" if undecided else ""
    runs = [f"{_runs(kept)} kept from before"] * (kept > 0) + [f"{_runs(failed)} failed"] * (failed > 0)
    return f"{said} ({', '.join(runs)})" if runs else said


class _Bar:
    """A bar of all runs, by the time that they take; on no terminal only a line for each analysis that is complete."""

    def __init__(self, console: Console, todo: Sequence[Piece]) -> None:
        columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.percentage:>3.0f} %"))
        self._progress = Progress(*columns, TimeElapsedColumn(), TimeRemainingColumn(), console=console, transient=True)
        self._runs = self._progress.add_task("all runs", total=max(sum(one.analysis.seconds for one in todo), 1.0))
        self._left = [one.run for one in todo]
        self._of_analysis = {one.run: one for one in todo}
        self._shares: dict[Run, float] = {}

    def __enter__(self) -> _Bar:
        self._progress.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._progress.stop()

    def advanced(self, piece: Piece, share: float) -> None:
        """See `Watcher`."""
        self._shares[piece.run] = share
        done = sum(self._of_analysis[run].analysis.seconds * one for run, one in dict(self._shares).items())
        self._progress.update(self._runs, completed=done, description=f"{piece.run.name} {piece.run.seed}")

    def ended(self, piece: Piece, record: Record, entry: Entry) -> bool:
        """Say what came out, where that was the analysis' last run; returns whether it was."""
        self._left.remove(piece.run)
        self.advanced(piece, 1.0)
        said = self._progress.console.print
        if not isinstance(record, Done):
            said(f"[red]failed[/] {piece.run.name} {piece.run.seed}: ", end="", soft_wrap=True)
            said(record.reason, markup=False, soft_wrap=True)
        if any(run.name == piece.run.name for run in self._left):
            return False
        if entry.summary is None:
            return True
        parts = [f"[{_STYLES[holds]}]{holds.of(count)}[/]" for holds in Holds if (count := entry.summary.count(holds))]
        said(f"{piece.run.name:<20} {', '.join(parts)} [dim]{entry.summary.seconds:.0f} s of work[/]", soft_wrap=True)
        return True
