"""Carries analyses out, here or in processes of their own, and keeps each outcome as soon as there is one."""

from __future__ import annotations

import logging
import multiprocessing
import os
import signal
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnProcess
from typing import Protocol

from threadpoolctl import threadpool_limits

from services.process.clock import SystemClock
from services.process.lifeline import die_with_parent
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


def carry_out(
    todo: Sequence[Analysis], store: Store, seed: int, jobs: int, watcher: Watcher
) -> Iterator[tuple[Analysis, Outcome]]:
    """Carry out analyses; the outcomes come as they are ready, and are kept by then.

    Closing the iterator, or an exception in whoever consumes it, stops what is still running.

    Args:
        todo: what is to be done.
        store: where outcomes are kept.
        seed: of the analyses.
        jobs: how many at once; more than one get a process each.
        watcher: is told of the progress.

    Raises:
        CannotKeep: an outcome cannot be kept.
    """
    if jobs > 1 and len(todo) > 1:
        yield from _apart(todo, store, seed, jobs, watcher)
        return
    for analysis in todo:
        watcher.started(analysis)
        context = Context(seed, lambda share, analysis=analysis: watcher.advanced(analysis, share))  # type: ignore[misc]
        outcome = _outcome(analysis, context)
        store.write(analysis.name, outcome)
        yield analysis, outcome


def _outcome(analysis: Analysis, context: Context) -> Outcome:
    clock = SystemClock()
    began_ns = clock.now_ns()
    try:
        # The matrices are small and the cores few: threads of the linear algebra would only wait for each other.
        with threadpool_limits(1):
            finding = analysis.run(context)
    except Exception as error:
        # One that fails is a line in the report, whatever it fails by: the others go on.
        log.debug("traceback", exc_info=True)
        said = " ".join(str(error).split())
        return Failed(f"{type(error).__name__}: {said}" if said else type(error).__name__)
    return Done(finding, (clock.now_ns() - began_ns) / 1e9)


@dataclass
class _Running:
    analysis: Analysis
    process: SpawnProcess
    reports: Connection


def _apart(
    todo: Sequence[Analysis], store: Store, seed: int, jobs: int, watcher: Watcher
) -> Iterator[tuple[Analysis, Outcome]]:
    waiting, running = list(todo), list[_Running]()
    try:
        while waiting or running:
            while waiting and len(running) < jobs:
                analysis = waiting.pop(0)
                watcher.started(analysis)
                running.append(_start(analysis, store, seed))
            ready = wait([one.reports for one in running])
            for one in [r for r in running if r.reports in ready]:
                share = _received(one.reports)
                if share is not None:
                    watcher.advanced(one.analysis, share)
                    continue
                running.remove(one)
                one.reports.close()
                one.process.join()
                yield one.analysis, _kept(one, store)
    finally:
        for one in running:
            one.process.terminate()
        for one in running:
            one.process.join()


def _start(analysis: Analysis, store: Store, seed: int) -> _Running:
    store.forget(analysis.name)
    spawn = multiprocessing.get_context("spawn")
    receiver, sender = spawn.Pipe(duplex=False)
    arguments = (analysis, store, seed, sender, os.getpid())
    process = spawn.Process(target=_process, args=arguments, name=analysis.name, daemon=True)
    process.start()
    sender.close()
    return _Running(analysis, process, receiver)


def _received(reports: Connection) -> float | None:
    """The next share that a process reports; None when it has ended."""
    try:
        return float(reports.recv())
    except (EOFError, OSError):
        return None


def _kept(one: _Running, store: Store) -> Outcome:
    outcome = store.read(one.analysis.name)
    if outcome is not None:
        return outcome
    failed = Failed(f"its process ended with code {one.process.exitcode} before it was done")
    store.write(one.analysis.name, failed)
    return failed


def _process(analysis: Analysis, store: Store, seed: int, reports: Connection, parent: int) -> None:
    die_with_parent(parent)
    # Ctrl-C reaches every process of the terminal: the parent decides what it means.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    last = 0.0

    def advance(share: float) -> None:
        nonlocal last
        if share - last >= _LEAST_ADVANCE:
            last = share
            with suppress(OSError):
                reports.send(share)

    store.write(analysis.name, _outcome(analysis, Context(seed, advance)))
