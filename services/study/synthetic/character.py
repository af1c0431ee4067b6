"""Who a synthetic participant is: hand, eyes, stamina, background, and how they fill in forms; all from one seed."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from services.offline.people.person import Character
from sim.person.attention import REACTION
from sim.person.scatter import USUAL

MISJUDGED = 0.01
"""Median standard deviation of the depth that is misjudged [m]."""


@dataclass(frozen=True)
class Nature:
    """Of one person.

    Attributes:
        seed: of all that they do not mean.
        skill: their motions scatter by so many times as much as is usual; less is better.
        reaction: from seeing to acting [s].
        misjudgement: of depth, standard deviation [m].
        askew: by how much they misjudge a device's axes [rad].
        fatigue: by how much more their motions scatter after an hour.
        severity: how much worse than others they rate the same, in points of 100.
        spread: of their ratings about that, in points of 100.
    """

    seed: int
    skill: float
    reaction: float
    misjudgement: float
    askew: float
    fatigue: float
    severity: float
    spread: float

    @classmethod
    def drawn(cls, seed: int) -> Nature:
        """A person out of the crowd.

        Args:
            seed: theirs.
        """
        rng = np.random.default_rng((seed, 11))
        return cls(
            seed=seed,
            skill=math.exp(rng.normal(0.0, 0.25)),
            reaction=float(REACTION + abs(rng.normal(0.0, 0.04))),
            misjudgement=MISJUDGED * math.exp(rng.normal(0.0, 0.3)),
            askew=float(rng.normal(0.0, math.radians(6.0))),
            fatigue=float(abs(rng.normal(0.0, 0.15))),
            severity=float(rng.normal(0.0, 10.0)),
            spread=float(rng.uniform(3.0, 8.0)),
        )

    def character(self, hours: float, part: int) -> Character:
        """As they teach.

        Args:
            hours: since they began.
            part: of the session, so that no two are the same.
        """
        return Character(
            seed=int(np.random.default_rng((self.seed, part)).integers(2**31)),
            scatter=USUAL * self.skill * (1.0 + self.fatigue * hours),
            misjudgement=self.misjudgement,
            reaction=self.reaction,
            askew=self.askew,
            looks_first=True,
        )
