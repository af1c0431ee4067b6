"""The models that the analyses compare: from the thesis' to the default, one difference at a time.

The default model begins where the robot is, and draws a motion with forty basis functions; the thesis' does neither. So
that a difference between them is one of how they learn, the thesis' model is there with the start anchor too, and with
anchor and resolution; and the default with the thesis' resolution. The DMP is what the thesis tried first.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from lfd.models.adaptive.adaptation import AdaptiveOptions, AdaptiveProMP
from lfd.models.promp import ConditionedProMP, PrompOptions
from lfd.motion.demonstration import Demonstration
from services.model.learning import Fit
from services.reproduction.primitive import NearestPrimitive
from services.reproduction.style import ADAPTIVE, ANCHORED_LINE, COARSE_LINE, CONDITIONED, FINE_LINE, LED, Line

_THESIS, _DEFAULT = PrompOptions(), AdaptiveOptions()
_ANCHORED = replace(_THESIS, anchored=True)
_FINE = replace(_ANCHORED, basis=_DEFAULT.basis, samples=_DEFAULT.samples)
_COARSE = replace(_DEFAULT, basis=_THESIS.basis, samples=_THESIS.samples)


@dataclass(frozen=True)
class Contender:
    """One of the models.

    Attributes:
        name: short and unique: the model process' own, of those that it knows.
        label: in a legend and above a column.
        line: of its predictions.
        fit: makes a model of demonstrations.
    """

    name: str
    label: str
    line: Line
    fit: Fit


def _anchored(demonstrations: Sequence[Demonstration]) -> ConditionedProMP:
    return ConditionedProMP.fit(demonstrations, _ANCHORED)


def _fine(demonstrations: Sequence[Demonstration]) -> ConditionedProMP:
    return ConditionedProMP.fit(demonstrations, _FINE)


def _coarse(demonstrations: Sequence[Demonstration]) -> AdaptiveProMP:
    return AdaptiveProMP.fit(demonstrations, _COARSE)


THESIS = Contender("promp", "thesis' model", Line(CONDITIONED, 3.2), ConditionedProMP.fit)
ANCHORED = Contender("promp-anchored", "thesis' model + anchor", ANCHORED_LINE, _anchored)
FINE = Contender("promp-fine", f"thesis' model + anchor, {_FINE.basis.count} functions", FINE_LINE, _fine)
PRIMITIVE = Contender("dmp", "DMP", Line(LED, 1.3), NearestPrimitive.fit)
COARSE = Contender("adaptive-coarse", f"default model, {_COARSE.basis.count} functions", COARSE_LINE, _coarse)
DEFAULT = Contender("adaptive", "default model", Line(ADAPTIVE, 1.5), AdaptiveProMP.fit)

CONTENDERS = (THESIS, ANCHORED, FINE, PRIMITIVE, COARSE, DEFAULT)
"""In the order of the report's columns."""

LEARNT = (THESIS, ANCHORED, FINE, COARSE, DEFAULT)
"""Those that learn from several motions how they depend on the condition."""

SHOWN = (THESIS, DEFAULT)
"""Those whose every prediction is drawn; the others would fill pages."""

BY_NAME = {contender.name: contender for contender in CONTENDERS}
FITS = {contender.name: contender.fit for contender in CONTENDERS}
