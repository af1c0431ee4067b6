"""How the report says its numbers."""

from __future__ import annotations

import math

from services.study.analysis.effects import Effect

_LEAST_P = 0.001
_LARGE = 100.0
_MINUS = "−"
_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def figure(value: float | None, digits: int | None = None) -> str:
    """A number: three digits of it, or so many decimals; a dash where there is none.

    Args:
        value: to say.
        digits: after the point.
    """
    if value is None or math.isnan(value):
        return "–"
    if math.isinf(value):
        return "not adapted"
    if digits is None:
        digits = 0 if abs(value) >= _LARGE else 1 if abs(value) >= 10.0 else 2
    said = f"{value:.{digits}f}"
    return (said.removeprefix("-") if float(said) == 0.0 else said).replace("-", _MINUS)


def p_value(p: float | None) -> str:
    """As papers have it: three decimals, and below a thousandth no more than that."""
    if p is None:
        return "–"
    return "< 0.001" if p < _LEAST_P else f"{p:.3f}"


def exactly(p: float | None) -> str:
    """A p-value with three digits, however small; for tables that others are compared with."""
    if p is None:
        return "–"
    if p >= 1e-4 or p == 0.0:
        return f"{p:.3g}"
    digits, exponent = f"{p:.2e}".split("e")
    return f"{digits} · 10{str(int(exponent)).translate(_SUPERSCRIPT)}"


def equals(said: str) -> str:
    """A value as it follows its letter: "= 0.03", "< 0.001"."""
    return said if said.startswith("<") else f"= {said}"


def interval(effect: Effect, digits: int | None = None) -> str:
    """From where to where; empty where nothing bounds it."""
    if effect.low is None or effect.high is None:
        return ""
    return f"{figure(effect.low, digits)} to {figure(effect.high, digits)}"
