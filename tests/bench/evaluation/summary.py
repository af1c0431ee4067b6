"""What the default model reaches: beside its goals, the thesis' model and the best baseline."""

from dataclasses import dataclass

import numpy as np

from tests.bench.baselines.models import BASELINES, DEFAULT, MODELS, THESIS

DEGENERATE = 2  # conditions: one of two left out leaves a single one, from which nothing about the condition is learnt


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
    if transfers:
        share = {t.model: t.median for t in transfers}
        results.append(_lowest("gap left after somebody else's correction, median", share, 0.60, "of the gap"))
        worse = {t.model: t.worse for t in transfers}
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
            results.append(_lower_by(f"the same without sets of {DEGENERATE} conditions", of_several))
        ratios = {m: _worst_ratio(left_out, error, m) for m in (DEFAULT, THESIS)}
        worst = max(bests(left_out, error), key=lambda b: b.ratio)
        goal, met = "at most 1.02", ratios[DEFAULT] <= 1.02
        name = f"left-out {error} error, worst set"
        results.append(Figure(name, *ratios.values(), 1.0, worst.best_model, "of the best", goal, met))
    cover = {m: _weighted([r for r in left_out if r.model == m]) for m in MODELS}
    best = min(BASELINES, key=lambda m: abs(cover[m] - 0.9))
    met = 0.85 <= cover[DEFAULT] <= 0.95
    values = cover[DEFAULT], cover[THESIS], cover[best]
    return [*results, Figure("90 % intervals cover", *values, best, "of the points", "0.85 to 0.95", met)]


def _lowest(name, values, goal, unit):
    best = min(BASELINES, key=lambda m: values[m])
    default, thesis, of_best = (float(values[m]) for m in (DEFAULT, THESIS, best))
    return Figure(name, default, thesis, of_best, best, unit, f"at most {goal:g}", default <= goal)


def _lower_by(name, values):
    best = min(BASELINES, key=lambda m: values[m])
    gain = 1.0 - values[DEFAULT] / values[best]
    goal = f"8 % under the best ({gain:.1%})"
    return Figure(name, values[DEFAULT], values[THESIS], values[best], best, "m", goal, gain >= 0.08)


def _worst_ratio(left_out, error, model):
    of_model = {r.name: getattr(r, error) for r in left_out if r.model == model}
    return max(of_model[b.name] / b.best for b in bests(left_out, error))


def _medians(values):
    return {m: float(np.median(x)) for m, x in values.items()}


def _mean(rows, error):
    return float(np.mean([getattr(r, error) for r in rows]))


def _weighted(rows):
    return float(np.average([r.coverage for r in rows], weights=[r.demonstrations for r in rows]))
