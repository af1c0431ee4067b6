"""Independent pieces of work on all cores, in processes that are started afresh."""

from __future__ import annotations

import os
import signal
import warnings
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from multiprocessing import get_context
from multiprocessing.managers import SyncManager
from queue import Queue
from threading import Thread
from typing import TypeVar

from joblib import Parallel, delayed
from joblib.externals.loky import get_reusable_executor
from joblib.externals.loky.process_executor import TerminatedWorkerError

from services.process.exceptions import CommandFailed
from services.process.lifeline import die_with_parent

Item = TypeVar("Item")
Result = TypeVar("Result")

Progress = Callable[[float], None]
"""Called with the share of the work that is done, from 0 to 1."""

Advance = Callable[[int, float], None]
"""Called with the number of an item and the share of it that is done: 0 when it is begun, 1 at its end."""

States = Queue[tuple[int, float] | None]

_apart = False  # whether this is a process of the pool


class ProcessDied(CommandFailed):
    """A process of the pool was killed, or crashed; what the others were at is lost with it."""

    def __init__(self) -> None:
        super().__init__("a process ended before its work was done: killed, or out of memory")


def each(
    work: Callable[[Item, Progress], Result], items: Sequence[Item], jobs: int, advance: Advance = lambda *_: None
) -> Generator[tuple[int, Result], None, None]:
    """Do the same work on every item; what is ready comes first.

    Closing the iterator ends what is still running. In a process of the pool, and with one job, the items are
    dealt with here, one after another.

    Args:
        work: a function of a module, so that another process finds it; the item and the result cross by pickle.
        items: to work on.
        jobs: processes at most.
        advance: is told how each item goes on; from another thread where there are processes.

    Yields:
        The number of an item and its result.

    Raises:
        ProcessDied: a process did not live to the end of its work.
    """
    if min(jobs, len(items)) <= 1 or _apart:
        for number, item in enumerate(items):
            yield _done(work, item, number, advance)
        return
    with _reports(advance) as reports:
        parallel = Parallel(
            min(jobs, len(items)),
            backend="loky",
            return_as="generator_unordered",
            batch_size=1,
            initializer=_begin,
            initargs=(os.getpid(),),
        )
        results = parallel(delayed(_report)(work, item, number, reports) for number, item in enumerate(items))
        try:
            for result in results:  # noqa: UP028 - it is closed below, after what it warns of
                yield result
        except TerminatedWorkerError:
            raise ProcessDied from None
        finally:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # whoever closes it knows that work is left undone
                results.close()
            get_reusable_executor().shutdown(wait=True, kill_workers=True)


def overall(count: int, progress: Progress) -> Advance:
    """What tells of `count` items together."""
    shares = [0.0] * count

    def advance(number: int, share: float) -> None:
        shares[number] = share
        progress(sum(shares) / count)

    return advance


def _done(work: Callable[[Item, Progress], Result], item: Item, number: int, advance: Advance) -> tuple[int, Result]:
    advance(number, 0.0)
    result = work(item, partial(advance, number))
    advance(number, 1.0)
    return number, result


@contextmanager
def _reports(advance: Advance) -> Iterator[States]:
    """A queue that reaches from the processes to here, and is listened to until what follows is done."""
    manager = SyncManager(ctx=get_context("spawn"))
    manager.start(_begin, (os.getpid(),))
    with manager:
        reports: States = manager.Queue()
        listener = Thread(target=_listen, args=(reports, advance), daemon=True)
        listener.start()
        try:
            yield reports
        finally:
            reports.put(None)
            listener.join()


def _listen(reports: States, advance: Advance) -> None:
    while (report := reports.get()) is not None:
        advance(*report)


def _begin(parent: int) -> None:
    global _apart  # noqa: PLW0603 - a process belongs to the pool for all its life
    _apart = True
    die_with_parent(parent)
    # Ctrl-C reaches every process of the terminal: the parent decides what it means.
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _report(work: Callable[[Item, Progress], Result], item: Item, number: int, reports: States) -> tuple[int, Result]:
    return _done(work, item, number, lambda number, share: reports.put((number, share)))
