"""How far long work has come, on a terminal."""

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
    """A bar of work that tells only its share.

    Args:
        console: to draw it on.
        work: what is done.

    Yields:
        What takes the share that is done, from 0 to 1.
    """
    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True) as progress:
        task = progress.add_task(work, total=1.0)
        yield lambda share: progress.update(task, completed=share)
