"""The two models that every analysis compares, and how they are told apart in its plots."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from lfd.models.adaptive.adaptation import AdaptiveProMP
from lfd.models.model import MovementModel
from lfd.models.promp import ConditionedProMP
from lfd.motion.demonstration import Demonstration
from services.reproduction.style import ADAPTIVE, CONDITIONED, Line


@dataclass(frozen=True)
class Contender:
    """One of the two models.

    Attributes:
        label: in a legend.
        line: of its predictions.
        fit: makes a model of demonstrations.
    """

    label: str
    line: Line
    fit: Callable[[Sequence[Demonstration]], MovementModel]


THESIS = Contender("thesis' method", Line(CONDITIONED, 3.2), ConditionedProMP.fit)
DEFAULT = Contender("default model", Line(ADAPTIVE, 1.5), AdaptiveProMP.fit)
CONTENDERS = (THESIS, DEFAULT)
"""In the order of a row's columns, `conditioned` and `adaptive`."""

BY_NAME = {"promp": THESIS, "adaptive": DEFAULT}
"""By the name that the model process knows them by."""
