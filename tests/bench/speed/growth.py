"""Fit, update, prediction and memory of both models as the demonstrations become many.

Warm: everything is run once before it is timed, so what is worked out once and kept counts for nothing but the fit.
"""

import sys
import tracemalloc

from lfd.models.adaptive.adaptation import AdaptiveProMP
from lfd.models.promp import ConditionedProMP
from tests.bench.speed.primitives import demonstrations
from tests.bench.support.results import Result
from tests.bench.support.timing import Contender, compare

MODELS = {"default model": AdaptiveProMP, "thesis' model": ConditionedProMP}
COUNTS = (10, 100, 1000, 10_000)
GOALS = {  # of the default model [ms], by the number of demonstrations
    "update and the prediction after it": {10: 0.8, 100: 1.0, 1000: 10.0},
    "prediction": {10: 0.15, 100: 0.15},
}
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
            learnt[name], figures = _memory(name, model, taught[:count], new)
            memory += figures
        timings = _times(learnt, taught[:count], new, effort)
        results += [*timings, *memory]
        for name in learnt:
            # A fit is made once, an update and a prediction for each correction.
            slowest = max(t.value for t in timings if t.name == name and not t.operation.startswith("fit")) / 1e3
            # Where the work grows with the cube, ten times the demonstrations take a thousand times as long.
            if 1000.0 * slowest > PATIENCE_S:
                models.pop(name)
                print(f"bench: {name}: no more demonstrations, they may take {1000 * slowest:.0f} s", file=sys.stderr)
    return results


def _times(learnt, taught, new, effort):
    situation, results = new.situation, []
    for operation, act in (
        ("fit", lambda model: lambda: type(model).fit(taught)),
        ("update", lambda model: lambda: model.updated(new)),
        ("update and the prediction after it", lambda model: lambda: model.updated(new).predict(situation)),
        ("prediction", lambda model: lambda: model.predict(situation)),
    ):
        goal = GOALS.get(operation, {}).get(len(taught))
        contenders = [
            Contender(name, act(learnt[name]), goal if name == "default model" else None)
            if name in learnt
            else Contender(name, None, note="left out: would take too long")
            for name in MODELS
        ]
        results += compare(f"{operation}, {len(taught)} demonstrations", contenders, effort)
    return results


def _memory(name, model, taught, new):
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
