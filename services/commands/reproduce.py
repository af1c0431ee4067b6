"""`retouch reproduce`: makes the thesis' analyses again and writes one report."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskID, TextColumn, TimeElapsedColumn

from services.commands.arguments import add_debug, whole
from services.commands.terminal import Terminal
from services.process.exit_codes import Exit
from services.process.runner import interruptible
from services.reproduction.analyses import ANALYSES
from services.reproduction.analysis import Analysis, Holds
from services.reproduction.exceptions import UnknownAnalysis
from services.reproduction.report import write_report
from services.reproduction.store import Done, Failed, Outcome, Store, code_key
from services.reproduction.work import carry_out

_SAID = {
    Holds.YES: "[green]confirmed[/]",
    Holds.NO: "[red]not confirmed[/]",
    Holds.DIFFERS: "[yellow]differs[/]",
}


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = (
        "Makes the thesis' analyses again, with its method and with the default model, and writes one HTML report.\n"
        "What is done already is kept, and done again only where the code or the seed has changed."
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help="of analyses (default: all)")
    parser.add_argument("--list", action="store_true", help="name the analyses and end")
    parser.add_argument(
        "--out", type=Path, metavar="FOLDER", default=Path("reproduction"), help="default: ./reproduction"
    )
    parser.add_argument("--fresh", action="store_true", help="do again what is done already")
    parser.add_argument("--jobs", type=whole(1), metavar="N", default=1, help="analyses at once (default: 1)")
    parser.add_argument("--seed", type=whole(0), metavar="N", default=0, help="of all that is random (default: 0)")
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
        jobs: analyses at once.
        seed: of all that is random.
    """

    names: tuple[str, ...]
    out: Path
    fresh: bool
    jobs: int
    seed: int

    @classmethod
    def from_arguments(cls, arguments: Namespace) -> Self:
        """Of the command's flags."""
        return cls(tuple(arguments.names), arguments.out, arguments.fresh, arguments.jobs, arguments.seed)


def reproduce(request: Request, analyses: Sequence[Analysis] = ANALYSES) -> int:
    """Carry out what is asked for and not kept yet, and write the report.

    Args:
        request: what to do.
        analyses: all there are.

    Returns:
        The exit code: 0, or 1 where an analysis failed.

    Raises:
        UnknownAnalysis: a name is none's.
        CannotKeep: the folder cannot be written.
    """
    chosen = choose(request.names, analyses)
    store = Store(request.out, code_key(request.seed))
    kept = {a.name: outcome for a in analyses if (outcome := store.read(a.name)) is not None}
    todo = [a for a in chosen if request.fresh or not isinstance(kept.get(a.name), Done)]
    outcomes = {name: outcome for name, outcome in kept.items() if name not in {a.name for a in todo}}
    console = Terminal(stderr=True, highlight=False)
    report = write_report(request.out, analyses, outcomes, request.seed)
    try:
        with _Bars(console, len(todo)) as bars:
            for analysis, outcome in carry_out(todo, store, request.seed, request.jobs, bars):
                bars.ended(analysis, outcome)
                outcomes[analysis.name] = outcome
                write_report(request.out, analyses, outcomes, request.seed)
    except KeyboardInterrupt:
        left = sum(a.name not in outcomes for a in todo)
        console.print(f"interrupted with {left} to go; the same command goes on; so far: {report}", soft_wrap=True)
        raise
    found = [outcomes[a.name] for a in chosen]
    failed = sum(isinstance(outcome, Failed) for outcome in found)
    console.print(f"{len(found)} analyses: {len(found) - len(todo)} kept from before, {failed} failed")
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


class _Bars:
    """A bar for all analyses and one for each that runs; on no terminal only a line for each that has ended."""

    def __init__(self, console: Console, total: int) -> None:
        columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.percentage:>3.0f} %"))
        self._progress = Progress(*columns, TimeElapsedColumn(), console=console, transient=True)
        self._all = self._progress.add_task("all analyses", total=max(total, 1))
        self._tasks: dict[str, TaskID] = {}

    def __enter__(self) -> _Bars:
        self._progress.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._progress.stop()

    def started(self, analysis: Analysis) -> None:
        """See `Watcher`."""
        self._tasks[analysis.name] = self._progress.add_task(analysis.name, total=1.0)

    def advanced(self, analysis: Analysis, share: float) -> None:
        """See `Watcher`."""
        self._progress.update(self._tasks[analysis.name], completed=share)

    def ended(self, analysis: Analysis, outcome: Outcome) -> None:
        """Say what came out."""
        self._progress.remove_task(self._tasks.pop(analysis.name))
        self._progress.advance(self._all)
        match outcome:
            case Done(finding, seconds):
                said = f"{_SAID[finding.holds]} [dim]{seconds:.1f} s[/]"
            case Failed():
                said = "[red]failed[/]"
        self._progress.console.print(f"{analysis.name:<20} [dim]{analysis.reference:<24}[/] {said}", soft_wrap=True)
        if isinstance(outcome, Failed):
            self._progress.console.print(f"  {outcome.reason}", markup=False, soft_wrap=True)
