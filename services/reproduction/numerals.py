"""How the report says numbers."""

from __future__ import annotations

import numpy as np

from services.offline.proportion import Proportion
from services.reproduction.analysis import Value
from services.reproduction.summary import Cell, Estimate, Judgement

_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_DIGITS = 3
_NOTHING = 1e-9  # of any unit that a length, an angle or a time is given in here: rounding, not a measurement


def shown(value: Cell | Value | None, unit: str = "") -> str:
    """A value: three digits, powers of ten where they read better, with the unit; a text as it is.

    Args:
        value: to say, of many people or of one.
        unit: of a number.
    """
    match value:
        case None:
            said = "–"
        case str():
            said = value
        case bool() | Proportion(_, 1):
            said = "yes" if value in (True, Proportion(1, 1)) else "no"
        case Proportion(successes, trials):
            said = f"{successes} of {trials}"
        case Estimate():
            said = _measured(value.mean, unit)
        case _:
            said = _measured(value, unit)
    return said


def interval(value: Cell | Value | None, unit: str = "") -> str:
    """The 95 % interval of what is a mean or a share; empty where there is none.

    Args:
        value: see `shown`.
        unit: of a mean.
    """
    match value:
        case Proportion(_, trials) if trials > 1:
            low, high = (round(100.0 * bound) for bound in value.interval)
            return f"{low}–{high} %"
        case Estimate(_, low, high, people) if people > 1:
            said = [shown(bound, unit).removesuffix(f" {unit}" if unit else "") for bound in (low, high)]
            return f"{said[0]}–{said[1]}" if said[0] != said[1] else ""
    return ""


def bounded(judgement: Judgement) -> str:
    """What a claim's figure is held against: "≤ 2", or "< 3.1 (default model)".

    Args:
        judgement: of the claim.
    """
    claim = judgement.claim
    said = f"{claim.relation.value} {shown(judgement.bound, claim.unit)}"
    return f"{said} ({claim.against})" if claim.against else said


def _measured(value: float, unit: str) -> str:
    rounding = unit and abs(value) < _NOTHING
    return f"{_number(0.0 if rounding else value)} {unit}".rstrip().replace("-", "−")


def _number(value: float) -> str:
    if value == 0.0 or not np.isfinite(value):
        return f"{value:g}"
    if float(value).is_integer() and abs(value) < 1e6:
        return f"{value:.0f}"
    exponent = int(np.floor(np.log10(abs(value))))
    if not -4 <= exponent < 6:
        return f"{value / 10.0**exponent:.1f} · 10{str(exponent).translate(_SUPERSCRIPT)}"
    return f"{value:.{max(_DIGITS - 1 - exponent, 0)}f}"
