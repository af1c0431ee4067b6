"""Independent pieces of work on all cores, in processes that are started afresh."""

from __future__ import annotations

import contextlib
import logging
import os
import signal
import struct
import warnings
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from multiprocessing import Pipe, resource_tracker
from multiprocessing.connection import Connection
from pathlib import Path
from threading import Thread
from typing import TypeVar

from joblib import Parallel, delayed
from joblib.externals.loky import get_reusable_executor
from joblib.externals.loky.backend import resource_tracker as loky_tracker
from joblib.externals.loky.process_executor import TerminatedWorkerError

from services.process.ending import ENDING
from services.process.exceptions import CommandFailed
from services.process.lifeline import die_with_parent

Item = TypeVar("Item")
Result = TypeVar("Result")

Progress = Callable[[float], None]
"""Called with the share of the work that is done, from 0 to 1."""

Advance = Callable[[int, float], None]
"""Called with the number of an item and the share of it that is done: 0 when it is begun, 1 at its end."""

_REPORT = struct.Struct("qd")  # so short that a pipe takes it whole: nobody has to lock it, and may die when he likes
_NO_MORE = -1  # instead of an item's number

_reports: Connection | None = None  # to whoever shares the work out; only a process of the pool has one


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
    if min(jobs, len(items)) <= 1 or _reports is not None:
        for number, item in enumerate(items):
            with _silent():
                done = _done(work, item, number, advance)
            yield done
        return
    # What looks after shared memory is no process of the pool, and its start would let Ctrl-C through below.
    resource_tracker.ensure_running()
    loky_tracker.ensure_running()
    others = _children()
    # Whoever closes it, or interrupts it at any moment, knows that work is left undone.
    warnings.filterwarnings("ignore", ".* tasks which were still being processed", UserWarning)
    with _listening(advance) as reports:
        try:
            with _uninterrupted():
                parallel = Parallel(
                    min(jobs, len(items)),
                    backend="loky",
                    return_as="generator_unordered",
                    batch_size=1,
                    initializer=_begin,
                    initargs=(os.getpid(), reports),
                )
                results = parallel(delayed(_report)(work, item, number) for number, item in enumerate(items))
            try:
                for result in results:  # noqa: UP028 - it is closed below, after what it warns of
                    yield result
            except TerminatedWorkerError:
                raise ProcessDied from None
            finally:
                _kill(_children() - others)
                results.close()
        finally:
            _kill(_children() - others)
            get_reusable_executor().shutdown(wait=True, kill_workers=True)


def _children() -> set[int]:
    """The processes that this one has started, as the system tells: those too that are only being started."""
    return {int(pid) for of in Path("/proc/self/task").glob("*/children") for pid in of.read_text().split()}


def _kill(processes: set[int]) -> None:
    """End them at once: a busy machine takes seconds to end them in good order, and a signal leaves two."""
    for process in processes:
        with contextlib.suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)


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
def _silent() -> Iterator[None]:
    """What is done meanwhile says no more than it would in a process of the pool: what is wrong."""
    before = logging.root.manager.disable
    logging.disable(logging.INFO)
    try:
        yield
    finally:
        logging.disable(before)


@contextmanager
def _listening(advance: Advance) -> Iterator[Connection]:
    """A pipe that reaches from the processes to here, and is listened to until what follows is done."""
    receiver, sender = Pipe(duplex=False)
    listener = Thread(target=_listen, args=(receiver, advance), daemon=True)
    with receiver, sender:
        listener.start()
        try:
            yield sender
        finally:
            os.write(sender.fileno(), _REPORT.pack(_NO_MORE, 0.0))
            listener.join()


def _listen(receiver: Connection, advance: Advance) -> None:
    while True:
        number, share = _REPORT.unpack(os.read(receiver.fileno(), _REPORT.size))
        if number == _NO_MORE:
            return
        advance(number, share)


@contextmanager
def _uninterrupted() -> Iterator[None]:
    """What would interrupt this comes afterwards: a pool that is only half there cannot be ended.

    Processes that are started meanwhile never hear it, not even while they import: Ctrl-C reaches every process of the
    terminal, and the parent decides what it means.
    """
    came: list[int] = []
    # The mask is for the processes: here another thread may take a signal, and its handler runs all the same.
    handlers = {number: handler for number in ENDING if callable(handler := signal.getsignal(number))}
    for number in handlers:
        signal.signal(number, lambda number, _: came.append(number))
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ENDING)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        for number, handler in handlers.items():
            signal.signal(number, handler)
        if came:
            signal.raise_signal(came[0])


def _begin(parent: int, reports: Connection) -> None:
    global _reports  # noqa: PLW0603 - a process belongs to the pool for all its life
    _reports = reports
    die_with_parent(parent, signal.SIGKILL)  # all that would end it gently is blocked


def _report(work: Callable[[Item, Progress], Result], item: Item, number: int) -> tuple[int, Result]:
    return _done(work, item, number, _tell)


def _tell(number: int, share: float) -> None:
    assert _reports is not None
    os.write(_reports.fileno(), _REPORT.pack(number, share))
