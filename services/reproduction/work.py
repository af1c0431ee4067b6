"""Carries runs of analyses out, here or in processes of their own, and keeps each record as soon as there is one."""

from __future__ import annotations

import logging
import time
from collections.abc import Iterator, Sequence
from contextlib import closing
from typing import NamedTuple, Protocol

from threadpoolctl import threadpool_limits

from services.offline.pool import ProcessDied, Progress, each
from services.reproduction.analysis import Analysis, Context
from services.reproduction.store import Done, Failed, Record, Run, Store

log = logging.getLogger(__name__)

_LEAST_ADVANCE = 0.002  # share of the work below which a process does not report


class Piece(NamedTuple):
    """Of the work: one run of an analysis."""

    analysis: Analysis
    run: Run


class Watcher(Protocol):
    """Who is told how the work goes on."""

    def advanced(self, piece: Piece, share: float) -> None:
        """A share of a piece is done, from 0 to 1."""
        ...


def pieces_of(analysis: Analysis, seeds: Sequence[int]) -> list[Piece]:
    """The runs of an analysis: one for each person, of which the first is illustrated.

    Args:
        analysis: any.
        seeds: of the people, at least one.
    """
    taken = seeds if analysis.person else seeds[:1]
    return [Piece(analysis, Run(analysis.name, seed, illustrated=seed == taken[0])) for seed in taken]


def carry_out(todo: Sequence[Piece], store: Store, jobs: int, watcher: Watcher) -> Iterator[tuple[Piece, Record]]:
    """Carry out runs; the records come as they are ready, and are kept by then.

    Closing the iterator, or an exception in whoever consumes it, stops what is still running. A process that dies takes
    with it what was running at the time; the rest is begun anew.

    Args:
        todo: what is to be done.
        store: where records are kept.
        jobs: how many at once; more than one get a process each.
        watcher: is told of the progress.

    Raises:
        CannotKeep: a record cannot be kept.
    """
    waiting = list(todo)
    while waiting:
        pieces = list(waiting)
        running = set[int]()

        def advance(number: int, share: float, pieces: list[Piece] = pieces, running: set[int] = running) -> None:
            if share == 0.0:
                running.add(number)
            watcher.advanced(pieces[number], share)

        try:
            with closing(each(_record, pieces, jobs, advance)) as records:
                for number, record in records:
                    running.discard(number)
                    waiting.remove(pieces[number])
                    yield _kept(pieces[number], record, store)
        except ProcessDied as error:
            for number in sorted(running):
                waiting.remove(pieces[number])
                yield _kept(pieces[number], Failed(str(error)), store)


def _kept(piece: Piece, record: Record, store: Store) -> tuple[Piece, Record]:
    store.write(piece.run, record)
    return piece, record


def _record(piece: Piece, progress: Progress) -> Record:
    began = time.process_time()
    last = 0.0

    def advance(share: float) -> None:
        nonlocal last
        if share - last >= _LEAST_ADVANCE:
            last = share
            progress(share)

    try:
        # The matrices are small and the cores few: threads of the linear algebra would only wait for each other.
        with threadpool_limits(1):
            finding = piece.analysis.run(Context(piece.run.seed, advance, piece.run.illustrated))
    except Exception as error:
        # One that fails is a line in the report, whatever it fails by: the others go on.
        log.debug("traceback", exc_info=True)
        said = " ".join(str(error).split())
        return Failed(f"{type(error).__name__}: {said}" if said else type(error).__name__)
    return Done(finding, time.process_time() - began)
