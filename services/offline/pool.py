"""Independent pieces of work on all cores, in processes that are started afresh."""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from functools import partial
from multiprocessing.context import SpawnContext
from multiprocessing.managers import SyncManager
from queue import Empty, Queue
from typing import TypeVar

from services.process.lifeline import die_with_parent

Item = TypeVar("Item")
Result = TypeVar("Result")

Progress = Callable[[float], None]
"""Called with the share of the work that is done, from 0 to 1."""

_LISTEN_S = 0.2


def each(
    work: Callable[[Item, Progress], Result],
    items: Sequence[Item],
    jobs: int,
    progress: Progress = lambda _: None,
) -> Iterator[tuple[int, Result]]:
    """Do the same work on every item; what is ready comes first.

    Closing the iterator drops what has not begun. In a process that may have no children, and with one job, the items
    are dealt with here, one after another.

    Args:
        work: a function of a module, so that another process finds it; the item and the result cross by pickle.
        items: to work on.
        jobs: processes at most.
        progress: of all items together.

    Yields:
        The number of an item and its result.
    """
    shares = [0.0] * len(items)

    def advanced(number: int, share: float) -> None:
        shares[number] = share
        progress(sum(shares) / len(shares))

    if min(jobs, len(items)) <= 1 or multiprocessing.current_process().daemon:
        for number, item in enumerate(items):
            result = work(item, partial(advanced, number))
            advanced(number, 1.0)
            yield number, result
        return
    yield from _apart(work, items, min(jobs, len(items)), advanced)


def _apart(
    work: Callable[[Item, Progress], Result],
    items: Sequence[Item],
    jobs: int,
    advanced: Callable[[int, float], None],
) -> Iterator[tuple[int, Result]]:
    spawn = multiprocessing.get_context("spawn")
    with _manager(spawn) as manager:
        reports: Queue[tuple[int, float]] = manager.Queue()
        executor = ProcessPoolExecutor(jobs, spawn, _begin, (os.getpid(),))
        try:
            pending: dict[Future[Result], int] = {
                executor.submit(_report, work, item, number, reports): number for number, item in enumerate(items)
            }
            while pending:
                done, _ = wait(pending, _LISTEN_S, FIRST_COMPLETED)
                for number, share in _heard(reports):
                    advanced(number, share)
                for future in done:
                    number = pending.pop(future)
                    result = future.result()
                    advanced(number, 1.0)
                    yield number, result
        finally:
            executor.shutdown(cancel_futures=True)


def _manager(spawn: SpawnContext) -> SyncManager:
    """The process that owns the queue of reports; it does not outlive this one either."""
    manager = SyncManager(ctx=spawn)
    manager.start(die_with_parent, (os.getpid(),))
    return manager


def _begin(parent: int) -> None:
    die_with_parent(parent)
    # Ctrl-C reaches every process of the terminal: these have nothing to tidy up.
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def _report(
    work: Callable[[Item, Progress], Result], item: Item, number: int, reports: Queue[tuple[int, float]]
) -> Result:
    return work(item, lambda share: reports.put((number, share)))


def _heard(reports: Queue[tuple[int, float]]) -> Iterator[tuple[int, float]]:
    while True:
        try:
            yield reports.get_nowait()
        except Empty:
            return
