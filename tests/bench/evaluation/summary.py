"""What the default model reaches: beside its goals, the thesis' model and the best baseline."""

from dataclasses import dataclass

import numpy as np

from tests.bench.baselines.models import BASELINES, DEFAULT, MODELS, THESIS
from tests.bench.evaluation.refinements import ONE

DEGENERATE = 2  # conditions: one of two left out leaves a single one, from which nothing about the condition is learnt

MANY = 6  # conditions: enough to tell whether intervals hold what they promise
PROMISED = 0.9  # of left-out coordinates, inside 90 % intervals


@dataclass(frozen=True)
class Figure:
    """What the default model reaches beside its goal, the thesis' model, and the best baseline by that figure."""

    name: str
    default: float
    thesis: float
    best: float
    best_model: str
    unit: str
    goal: str
    met: bool


@dataclass(frozen=True)
class Best:
    """The best baseline on a set by one error [m], and the default model beside it."""

    name: str
    error: str
    conditions: int
    best_model: str
    best: float
    default: float

    @property
    def ratio(self):
        return self.default / self.best


@dataclass(frozen=True)
class Mean:
    """One model's mean over sets: errors [m], and over those of more than two conditions; None where none is left."""

    model: str
    time: float
    path: float
    end: float
    time_of_several: float | None
    path_of_several: float | None
    end_of_several: float | None


def bests(left_out, error):
    """Of each set."""
    results = []
    for default in (r for r in left_out if r.model == DEFAULT):
        rivals = [r for r in left_out if r.name == default.name and r.model in BASELINES]
        best = min(rivals, key=lambda r: getattr(r, error))
        values = getattr(best, error), getattr(default, error)
        results.append(Best(default.name, error, default.conditions, best.model, *values))
    return results


def means(left_out):
    """Of each model."""
    results = []
    for model in MODELS:
        own = [r for r in left_out if r.model == model]
        several = [r for r in own if r.conditions > DEGENERATE]
        if own:
            values = [_mean(own, error) for error in ("time", "path", "end")]
            values += [_mean(several, error) if several else None for error in ("time", "path", "end")]
            results.append(Mean(model, *values))
    return results


def figures(adaptations, transfers, left_out):
    """Everything that has a goal."""
    results = []
    if adaptations:
        results += _of_corrections(adaptations)
    if any(t.taught == ONE for t in transfers):
        share = {t.model: t.median for t in transfers if t.taught == ONE}
        results.append(_lowest("gap left after somebody else's correction, median", share, 0.60, "of the gap"))
        worse = {t.model: t.worse for t in transfers if t.taught == ONE}
        results.append(_lowest("worse than before somebody else's correction", worse, 0.08, "of the cases"))
    if left_out:
        results += _of_sets(left_out)
    return results


def first_shares(adaptations, model):
    """The gap left after one update, of each sequence [-]."""
    return np.array([a.left[0] for a in adaptations if a.model == model])


def later_shares(adaptations, model):
    """The gap left after each later update of each sequence [-]."""
    return np.array([x for a in adaptations if a.model == model for x in a.left[1:]])


def next_gaps(adaptations, model):
    """The gaps before all corrections of a sequence but the first [m]."""
    return np.array([x for a in adaptations if a.model == model for x in a.before[1:]])


def _of_corrections(adaptations):
    first, later, following = (
        {m: of(adaptations, m) for m in MODELS} for of in (first_shares, later_shares, next_gaps)
    )
    nine_in_ten = {m: np.quantile(x, 0.9) for m, x in first.items()}
    results = [
        _lowest("gap left after one update, median", _medians(first), 0.04, "of the gap"),
        _lowest("gap left after one update, nine in ten", nine_in_ten, 0.10, "of the gap"),
    ]
    if len(later[DEFAULT]):
        results.append(_lowest("gap left after later updates, median", _medians(later), 0.07, "of the gap"))
        results.append(_lowest("gap before the next correction, median", _medians(following), 0.10, "m"))
    return results


def _of_sets(left_out):
    results = []
    for error in ("time", "path"):
        of_all = {m: _mean([r for r in left_out if r.model == m], error) for m in MODELS}
        results.append(_lower_by(f"left-out {error} error, mean of the sets", of_all))
        several = [r for r in left_out if r.conditions > DEGENERATE]
        if several and len(several) < len(left_out):
            of_several = {m: _mean([r for r in several if r.model == m], error) for m in MODELS}
            results.append(_lower_by(f"left-out {error} error, sets of more than {DEGENERATE} conditions", of_several))
        results += [_beside_thesis(left_out, error), _beside_best(left_out, error)]
    return [*results, *_of_coverage(left_out)]


def _of_coverage(left_out):
    cover = {m: _weighted([r for r in left_out if r.model == m]) for m in MODELS}
    results = [_nearest_to_promised("90 % intervals cover", cover, (0.80, 0.97))]
    many = [r for r in left_out if r.conditions >= MANY]
    if many:
        worst = {m: max((r.coverage for r in many if r.model == m), key=_missed) for m in MODELS}
        name = f"90 % intervals cover, worst set of {MANY} conditions or more"
        results.append(_nearest_to_promised(name, worst, (0.85, 0.95)))
    return results


def _nearest_to_promised(name, cover, bounds):
    best = min(BASELINES, key=lambda m: _missed(cover[m]))
    met, goal = bounds[0] <= cover[DEFAULT] <= bounds[1], f"{bounds[0]:.2f} to {bounds[1]:.2f}"
    return Figure(name, cover[DEFAULT], cover[THESIS], cover[best], best, "of the points", goal, met)


def _missed(coverage):
    return abs(coverage - PROMISED)


def _lowest(name, values, goal, unit):
    best = min(BASELINES, key=lambda m: values[m])
    default, thesis, of_best = (float(values[m]) for m in (DEFAULT, THESIS, best))
    return Figure(name, default, thesis, of_best, best, unit, f"at most {goal:g}", default <= goal)


def _lower_by(name, values):
    best = min(BASELINES, key=lambda m: values[m])
    gain = 1.0 - values[DEFAULT] / values[best]
    goal = f"8 % under the best ({gain:.1%})"
    return Figure(name, values[DEFAULT], values[THESIS], values[best], best, "m", goal, gain >= 0.08)


def _beside_thesis(left_out, error):
    thesis = {r.name: getattr(r, error) for r in left_out if r.model == THESIS}
    worst = max(getattr(r, error) / thesis[r.name] for r in left_out if r.model == DEFAULT)
    name = f"left-out {error} error, worst set"
    return Figure(name, worst, 1.0, 1.0, THESIS, "of the thesis'", "at most 1", worst <= 1.0)


def _beside_best(left_out, error):
    every = bests(left_out, error)
    worst, best = max(every, key=lambda b: b.ratio), {b.name: b.best for b in every}
    thesis = max(getattr(r, error) / best[r.name] for r in left_out if r.model == THESIS)
    name = f"left-out {error} error, worst set beside its best"
    return Figure(name, worst.ratio, thesis, 1.0, worst.best_model, "of the best", "at most 1.02", worst.ratio <= 1.02)


def _medians(values):
    return {m: float(np.median(x)) for m, x in values.items()}


def _mean(rows, error):
    return float(np.mean([getattr(r, error) for r in rows]))


def _weighted(rows):
    return float(np.average([r.coverage for r in rows], weights=[r.demonstrations for r in rows]))
