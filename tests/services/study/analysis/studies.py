"""Studies that are made up: people with a skill and a style, methods with an effect or none."""

import math

from services.study.analysis.observations import Background, Observations, Outcome, Rating

METHODS = ("OnStyl", "OnKey", "OffStyl", "OffKey")
SEQUENCES = ((0, 1, 3, 2), (1, 2, 0, 3), (2, 3, 1, 0), (3, 0, 2, 1))
"""The thesis' Table E.1."""


def study(rng, *, people=18, models=3, online=1.0, easier=0.0, carried=0.0, learnt=0.0, synthetic=True):
    """A study in which everybody adapts everything.

    Args:
        rng: of all that is random.
        people: who take part.
        models: a method.
        online: times of online methods are shorter by this factor.
        easier: workload of online methods is less by so much.
        carried: logarithm of the time that an offline method before adds.
        learnt: logarithm of the time that each model takes off.
        synthetic: as the observations say.
    """
    outcomes, ratings, backgrounds = [], [], []
    skills, styles = rng.normal(0.0, 0.3, people).tolist(), rng.normal(0.0, 10.0, people).tolist()
    noise, felt = rng.normal(0.0, 0.4, (people, 4, models)).tolist(), rng.normal(0.0, 8.0, (people, 4)).tolist()
    tried, ages = rng.integers(1, 6, (people, 4, models)).tolist(), rng.integers(20, 60, people).tolist()
    for person in range(people):
        code, group = f"P{person + 1:02}", person % len(SEQUENCES)
        backgrounds.append(Background(participant=code, age=str(ages[person]), gender="woman", group=f"group {group}"))
        for position, index in enumerate(SEQUENCES[group], 1):
            method, before = METHODS[index], METHODS[SEQUENCES[group][position - 2]] if position > 1 else ""
            quick = method.startswith("On")
            usual = 5.0 + skills[person] - math.log(online) * quick + carried * before.startswith("Off")
            for model in range(1, models + 1):
                tries = tried[person][index][model - 1]
                outcomes.append(
                    Outcome(
                        participant=code,
                        method=method,
                        model=model,
                        position=position,
                        adapted=True,
                        seconds=math.exp(usual - learnt * model + noise[person][index][model - 1]),
                        refinements=tries,
                        updates=tries,
                    )
                )
            workload = 50.0 + styles[person] - easier * quick + felt[person][index]
            ratings.append(Rating(participant=code, method=method, workload=round(min(max(workload, 0.0), 100.0), 2)))
    return Observations(
        outcomes=tuple(outcomes),
        ratings=tuple(ratings),
        backgrounds=tuple(backgrounds),
        synthetic=synthetic,
        source="made up",
    )


def changed(observations, change):
    """The same study with every outcome changed; None leaves one out."""
    outcomes = tuple(one for one in map(change, observations.outcomes) if one is not None)
    return Observations(
        outcomes=outcomes,
        ratings=observations.ratings,
        backgrounds=observations.backgrounds,
        synthetic=observations.synthetic,
        source=observations.source,
    )
