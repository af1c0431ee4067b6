"""Carries analyses out, here or in processes of their own, and keeps each outcome as soon as there is one."""

from __future__ import annotations

import logging
from collections.abc import Iterator, Sequence
from contextlib import closing
from typing import NamedTuple, Protocol

from threadpoolctl import threadpool_limits

from services.offline.pool import ProcessDied, Progress, each
from services.process.clock import SystemClock
from services.reproduction.analysis import Analysis, Context
from services.reproduction.store import Done, Failed, Outcome, Store

log = logging.getLogger(__name__)

_LEAST_ADVANCE = 0.002  # share of the work below which a process does not report


class Watcher(Protocol):
    """Who is told how the work goes on."""

    def started(self, analysis: Analysis) -> None:
        """Work on an analysis begins."""
        ...

    def advanced(self, analysis: Analysis, share: float) -> None:
        """A share of its work is done, from 0 to 1."""
        ...


class _Piece(NamedTuple):
    analysis: Analysis
    seed: int


def carry_out(
    todo: Sequence[Analysis], store: Store, seed: int, jobs: int, watcher: Watcher
) -> Iterator[tuple[Analysis, Outcome]]:
    """Carry out analyses; the outcomes come as they are ready, and are kept by then.

    Closing the iterator, or an exception in whoever consumes it, stops what is still running. A process that dies takes
    with it what was running at the time; the rest is begun anew.

    Args:
        todo: what is to be done.
        store: where outcomes are kept.
        seed: of the analyses.
        jobs: how many at once; more than one get a process each.
        watcher: is told of the progress.

    Raises:
        CannotKeep: an outcome cannot be kept.
    """
    waiting = list(todo)
    while waiting:
        pieces = [_Piece(analysis, seed) for analysis in waiting]
        running = set[int]()

        def advance(number: int, share: float, pieces: list[_Piece] = pieces, running: set[int] = running) -> None:
            if share == 0.0:
                running.add(number)
                watcher.started(pieces[number].analysis)
            else:
                watcher.advanced(pieces[number].analysis, share)

        try:
            with closing(each(_outcome, pieces, jobs, advance)) as outcomes:
                for number, outcome in outcomes:
                    running.discard(number)
                    waiting.remove(pieces[number].analysis)
                    yield _kept(pieces[number].analysis, outcome, store)
        except ProcessDied as error:
            for number in sorted(running):
                waiting.remove(pieces[number].analysis)
                yield _kept(pieces[number].analysis, Failed(str(error)), store)


def _kept(analysis: Analysis, outcome: Outcome, store: Store) -> tuple[Analysis, Outcome]:
    store.write(analysis.name, outcome)
    return analysis, outcome


def _outcome(piece: _Piece, progress: Progress) -> Outcome:
    clock = SystemClock()
    began_ns = clock.now_ns()
    last = 0.0

    def advance(share: float) -> None:
        nonlocal last
        if share - last >= _LEAST_ADVANCE:
            last = share
            progress(share)

    try:
        # The matrices are small and the cores few: threads of the linear algebra would only wait for each other.
        with threadpool_limits(1):
            finding = piece.analysis.run(Context(piece.seed, advance))
    except Exception as error:
        # One that fails is a line in the report, whatever it fails by: the others go on.
        log.debug("traceback", exc_info=True)
        said = " ".join(str(error).split())
        return Failed(f"{type(error).__name__}: {said}" if said else type(error).__name__)
    return Done(finding, (clock.now_ns() - began_ns) / 1e9)
