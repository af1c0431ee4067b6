"""Studies that are drawn instead of acted: outcomes of people out of a population, a study in a millisecond or two.

The logarithm of the refinement time and the workload are each a person's own level, a method's effect, and the rest;
times are skewed as the thesis' are (its Fig. E.4). The spreads are assumptions: put those of a pilot in their place.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from services.study.analysis.hypotheses import Direction, Hypothesis
from services.study.analysis.observations import Observations, Outcome, Rating
from services.study.records import code

Rows = Sequence[Sequence[str]]


@dataclass(frozen=True)
class Population:
    """Of which people are drawn.

    Attributes:
        seconds: median refinement time [s].
        people: standard deviation of its logarithm between people.
        models: the same between the models of one person.
        workload: mean, in points of 100.
        raters: standard deviation of the workload between people.
        ratings: the same between the methods of one person.
        failing: probability that a model is not adapted.
    """

    seconds: float = 150.0
    people: float = 0.3
    models: float = 0.4
    workload: float = 45.0
    raters: float = 12.0
    ratings: float = 8.0
    failing: float = 0.02


@dataclass(frozen=True)
class Drawing:
    """What is drawn.

    Attributes:
        rows: orders of the methods, which take turns.
        people: how many.
        models: of each method.
        effect: share by which the first side of a hypothesis is better than the second, in time and in workload.
        about: the hypothesis that holds so; None where nothing does.
        population: of the people.
    """

    rows: Rows
    people: int
    models: int
    effect: float = 0.0
    about: Hypothesis | None = None
    population: Population = Population()


def drawn(drawing: Drawing, rng: np.random.Generator) -> Observations:
    """A study.

    Args:
        drawing: how.
        rng: of all that is random.
    """
    population, models, effect = drawing.population, drawing.models, drawing.effect
    better = _better(drawing.about)
    outcomes, ratings = [], []
    for person in range(drawing.people):
        order = drawing.rows[person % len(drawing.rows)]
        skill, style = rng.normal(0.0, population.people), rng.normal(0.0, population.raters)
        for position, method in enumerate(order, 1):
            share = 1.0 - effect if method in better else 1.0
            times = population.seconds * share * np.exp(skill + rng.normal(0.0, population.models, models))
            adapted = rng.random(models) >= population.failing
            felt = population.workload * share + style + rng.normal(0.0, population.ratings)
            outcomes += [
                Outcome(
                    participant=code(person + 1),
                    method=method,
                    model=model + 1,
                    position=position,
                    adapted=bool(adapted[model]),
                    seconds=float(times[model]) if adapted[model] else None,
                )
                for model in range(models)
            ]
            workload = min(100.0, max(0.0, round(float(felt), 2)))
            ratings.append(Rating(participant=code(person + 1), method=method, workload=workload))
    return Observations(outcomes=tuple(outcomes), ratings=tuple(ratings), synthetic=True, source="drawn")


def _better(hypothesis: Hypothesis | None) -> frozenset[str]:
    """Methods of the side that is to come out lower."""
    if hypothesis is None:
        return frozenset()
    return frozenset(hypothesis.second if hypothesis.direction is Direction.GREATER else hypothesis.first)
