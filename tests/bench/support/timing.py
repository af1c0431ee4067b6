"""Times of several ways to do one thing, taken in turns, so that what slows the machine down slows all of them down."""

import gc
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tests.bench.support.results import Result

MOST_RUNS = 2000
LONG_MS = 5000.0  # a first run that takes longer is the only one: what is filled once is no share of it to speak of


@dataclass(frozen=True)
class Effort:
    """How thoroughly to measure: for about `seconds` a contender, all sizes or the small ones, peers or not."""

    seconds: float = 1.0
    large: bool = True
    peers: bool = True


@dataclass(frozen=True)
class Contender:
    """One way to do it.

    `goal` is in milliseconds; `note` is what there is to say beside the time, such as an error. One without `run` is
    not there: it appears in the table with its note alone.
    """

    name: str
    run: Callable[[], object] | None
    goal: float | None = None
    note: str = ""


@dataclass(frozen=True)
class Timing(Result):
    """Processor time of one contender: `value` is the median; `ratio` is to the first contender's."""

    operation: str = ""
    p99: float = float("nan")
    least: float = float("nan")
    runs: int = 0
    ratio: float = float("nan")
    note: str = ""


def compare(operation, contenders, effort):
    """The times of the contenders, each running three times at least, unless one run is long."""
    print(f"bench: {operation}", file=sys.stderr)
    present = [c for c in contenders if c.run is not None]
    samples = {c.name: [] for c in present}
    counts = {}
    for contender in present:
        warming = _once(contender)  # imports, compiles, fills what is cached
        if warming > LONG_MS:
            samples[contender.name], counts[contender.name] = [warming], 0
        else:
            counts[contender.name] = int(np.clip(effort.seconds * 1e3 / max(_once(contender), 1e-3), 3, MOST_RUNS))
    turns = sorted((turn / counts[c.name], i) for i, c in enumerate(present) for turn in range(counts[c.name]))
    gc.collect()
    gc.disable()
    try:
        for _, i in turns:
            samples[present[i].name].append(_once(present[i]))
    finally:
        gc.enable()
    first = float(np.median(samples[present[0].name])) if present else float("nan")
    return [_timing(operation, c, samples.get(c.name), first) for c in contenders]


def _once(contender):
    began = time.thread_time_ns()
    contender.run()
    return (time.thread_time_ns() - began) / 1e6


def _timing(operation, contender, times, first):
    if times is None:
        return Timing(contender.name, float("nan"), "ms", operation=operation, note=contender.note)
    median = float(np.median(times))
    return Timing(
        contender.name,
        median,
        "ms",
        contender.goal,
        operation=operation,
        p99=float(np.percentile(times, 99)),
        least=min(times),
        runs=len(times),
        ratio=median / first,
        note=contender.note,
    )
