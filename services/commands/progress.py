"""How far long work has come, for whoever started it."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    Task,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.text import Text


class _Rate(TextColumn):
    """Conditions a second."""

    def __init__(self) -> None:
        super().__init__("")

    def render(self, task: Task) -> Text:
        """See the base."""
        return Text(f"{task.speed:.1f} /s" if task.speed else "")


class _Tenths:
    """Says each tenth once, the latest where several are done at once."""

    def __init__(self, console: Console, work: str) -> None:
        self._console, self._work = console, work
        self._said = 0

    def __call__(self, share: float) -> None:
        """Take the share that is done."""
        tenths = int(10.0 * share + 1e-9)
        if tenths > self._said:
            self._said = tenths
            self._console.print(f"{self._work}: {10 * tenths} %", markup=False, soft_wrap=True)


@contextmanager
def bar(console: Console, total: int) -> Iterator[Callable[[float], None]]:
    """A bar of conditions, with their rate and the time left.

    Args:
        console: to draw it on.
        total: conditions.

    Yields:
        What takes the share that is done, from 0 to 1.
    """
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), _Rate(), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True) as progress:
        task = progress.add_task("conditions", total=total)
        yield lambda share: progress.update(task, completed=round(share * total))


@contextmanager
def share_bar(console: Console, work: str) -> Iterator[Callable[[float], None]]:
    """A bar of work that tells only its share; where nobody sees one, a line at each tenth.

    Args:
        console: to draw it on.
        work: what is done.

    Yields:
        What takes the share that is done, from 0 to 1.
    """
    if not console.is_terminal:
        yield _Tenths(console, work)
        return
    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True) as progress:
        task = progress.add_task(work, total=1.0)
        yield lambda share: progress.update(task, completed=share)
