"""Update, prediction and memory of both models as the demonstrations become many."""

import sys
import tracemalloc

from lfd.models.adaptive.adaptation import AdaptiveProMP
from lfd.models.promp import ConditionedProMP
from tests.bench.speed.primitives import demonstrations
from tests.bench.support.results import Result
from tests.bench.support.timing import Contender, compare

MODELS = {"default model": AdaptiveProMP, "thesis' model": ConditionedProMP}
COUNTS = (10, 100, 1000, 10_000)
GOALS = {100: 1.0, 1000: 10.0}  # of the default model [ms]
PATIENCE_S = 20.0  # a size is left out if a model would take longer for one update and prediction


def measure(rng, effort):
    counts = COUNTS if effort.large else COUNTS[:2]
    print(f"bench: {counts[-1]} demonstrations are made", file=sys.stderr)
    taught = demonstrations(rng, counts[-1] + 1)
    new = taught.pop()
    results, models = [], dict(MODELS)
    for count in counts:
        print(f"bench: models of {count} demonstrations", file=sys.stderr)
        learnt, memory = {}, []
        for name, model in models.items():
            learnt[name], figures = _fit(name, model, taught[:count], new)
            memory += figures
        timings = _times(learnt, new, count, effort)
        results += [*timings, *memory]
        for name in learnt:
            slowest = max(t.value for t in timings if t.name == name) / 1e3
            # Where the work grows with the cube, ten times the demonstrations take a thousand times as long.
            if 1000.0 * slowest > PATIENCE_S:
                models.pop(name)
                print(f"bench: {name}: no more demonstrations, they may take {1000 * slowest:.0f} s", file=sys.stderr)
    return results


def _times(learnt, new, count, effort):
    def contenders(act):
        return [
            Contender(name, act(learnt[name]), GOALS.get(count) if name == "default model" else None)
            if name in learnt
            else Contender(name, None, note="left out: would take too long")
            for name in MODELS
        ]

    situation = new.situation
    return [
        *compare(f"update, {count} demonstrations", contenders(lambda m: lambda: m.updated(new)), effort),
        *compare(
            f"update and the prediction after it, {count} demonstrations",
            contenders(lambda m: lambda: m.updated(new).predict(situation)),
            effort,
        ),
        *compare(f"prediction, {count} demonstrations", contenders(lambda m: lambda: m.predict(situation)), effort),
    ]


def _fit(name, model, taught, new):
    """The model, and what it keeps in memory and takes at most to be fitted, updated and asked once."""
    tracemalloc.start()
    try:
        learnt = model.fit(taught)
        learnt.updated(new).predict(new.situation)
        kept, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    return learnt, [
        Result(f"{name}, {len(taught)} demonstrations: memory, kept", kept / 1e6, "MB"),
        Result(f"{name}, {len(taught)} demonstrations: memory, peak", peak / 1e6, "MB"),
    ]
