"""Sine waves: what a joint Gaussian of weights and condition can predict, and what it cannot (Appendix A)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from services.reproduction.analysis import Analysis, Context, Figure, Finding, Holds, Row
from services.reproduction.functions import TAUGHT, Family, X, rms
from services.reproduction.models import CONTENDERS
from services.reproduction.style import DEMONSTRATION_LINE, TRUE_LINE, TRUTH, Line, drawn, panels

Array = NDArray[np.float64]

PHASE = Family("sin(10x + b)", lambda x, b: np.sin(10.0 * x + b))
OFFSET = Family("sin(10x) + b", lambda x, b: np.sin(10.0 * x) + b)
TURNED = Family(PHASE.name, PHASE.value, lambda b: np.array([np.cos(b), np.sin(b)]))
"""The waves of `PHASE`, told apart by a condition in which they are linear: cos(b) sin(10x) + sin(b) cos(10x)."""

_BETWEEN = 2.5
_RIGHT = 0.05  # error that is hardly seen beside an amplitude of one


def best_affine(family: Family, b: float) -> Array:
    """What is nearest to a family's demonstrations in least squares among all functions that are affine in b.

    No joint Gaussian of weights and s = b can come nearer to them: its mean is affine in s (equation (8)).

    Args:
        family: of functions, demonstrated at `TAUGHT`.
        b: of the function asked for.

    Returns:
        Shape (n, outputs).
    """
    regressors = np.column_stack([np.ones(len(TAUGHT)), TAUGHT])
    values = np.array([family.outputs(taught).ravel() for taught in TAUGHT])
    coefficients = np.linalg.lstsq(regressors, values, rcond=None)[0]
    nearest: Array = (np.array([1.0, b]) @ coefficients).reshape(len(X), -1)
    return nearest


def _sine(context: Context) -> Finding:
    thesis, default = ({f: kind.fit(f.motions()) for f in (PHASE, OFFSET, TURNED)} for kind in CONTENDERS)
    questions = [
        ("RMSE of sin(10x + b) at s = b = 1, demonstrated", "“correct”", PHASE, 1.0),
        ("the same at s = b = 2.5, between", None, PHASE, _BETWEEN),
        ("RMSE of sin(10x) + b at s = b = 1, demonstrated", "“correct”", OFFSET, 1.0),
        ("the same at s = b = 2.5, between", None, OFFSET, _BETWEEN),
        ("RMSE of sin(10x + b) at s = [cos b, sin b], b = 1", None, TURNED, 1.0),
        ("the same at b = 2.5, between", None, TURNED, _BETWEEN),
    ]
    rows = [Row(said, "", text, f.error(thesis[f], b), f.error(default[f], b)) for said, text, f, b in questions]
    limit = rms(best_affine(PHASE, 1.0) - PHASE.outputs(1.0))
    rows.insert(2, Row("least RMSE of a joint Gaussian for sin(10x + b) at s = 1", "", None, limit, None))
    as_printed, as_meant = PHASE.error(thesis[PHASE], 1.0) < _RIGHT, OFFSET.error(thesis[OFFSET], 1.0) < _RIGHT
    if as_meant and not as_printed:
        holds = Holds.DIFFERS
        sentence = (
            "Not for the formula as it is printed: sin(10x + b) is not affine in b, and no joint Gaussian can predict"
            " it from s = b. It is so for sin(10x) + b, and for sin(10x + b) with s = [cos b, sin b]."
        )
    else:
        holds = Holds.YES if as_printed else Holds.NO
        sentence = (
            "The prediction of sin(10x + b) at s = 1 is the right one." if as_printed else "No sine is predicted."
        )
    return Finding(
        holds,
        sentence,
        tuple(rows),
        (_predictions_figure(), _errors_figure(context)),
        (
            "Equation (8) is affine in s, so the best that it can do is the least-squares fit of the demonstrations by"
            " functions that are affine in b; the conditioning noise adds almost nothing to that.",
            "The default model is not affine in s: it comes nearer to what was demonstrated. Between waves whose phases"
            " are one radian apart it can only blend them, unless the condition says what kind of motion it is.",
        ),
    )


def _predictions_figure() -> Figure:
    shown = [(PHASE, 1.0), (PHASE, _BETWEEN), (OFFSET, 1.0), (TURNED, _BETWEEN)]
    titles = [
        "sin(10x + b), s = b = 1",
        "sin(10x + b), s = b = 2.5",
        "sin(10x) + b, s = b = 1",
        "sin(10x + b), s = [cos b, sin b], b = 2.5",
    ]
    canvas, panes = panels(titles, rows=2, height=2.4)
    for axes, (family, b) in zip(panes, shown, strict=True):
        for taught in TAUGHT:
            axes.plot(X, family.outputs(taught), **DEMONSTRATION_LINE("demonstrations"))
        for kind in CONTENDERS:
            axes.plot(X, family.predicted(kind.fit(family.motions()), b), **kind.line(kind.label))
        axes.plot(X, family.outputs(b), **TRUE_LINE("the function itself"))
        axes.set(xlabel="x", ylabel="y")
    return drawn(canvas, "predictions", "Predictions of sine waves from demonstrations with b = 1 to 5.")


def _errors_figure(context: Context) -> Figure:
    values = np.linspace(0.0, 6.0, 31)
    canvas, panes = panels(["sin(10x + b), s = b", "sin(10x + b), s = [cos b, sin b]"], height=2.5)
    questions = [(axes, f, kind) for axes, f in zip(panes, (PHASE, TURNED), strict=True) for kind in CONTENDERS]
    for axes, family, kind in context.track(questions):
        model = kind.fit(family.motions())
        axes.plot(values, [family.error(model, float(b)) for b in values], **kind.line(kind.label))
    for axes in panes:
        axes.axvspan(min(TAUGHT), max(TAUGHT), color="#f1f4f7", zorder=0, label="demonstrated range")
        axes.set(xlabel="b of the prediction", ylabel="RMSE")
    limits = [rms(best_affine(PHASE, float(b)) - PHASE.outputs(float(b))) for b in values]
    panes[0].plot(values, limits, **Line(TRUTH, 1.2, ":")("best that is affine in b"))
    return drawn(
        canvas, "errors", "Error of the predictions over b; demonstrations were given at b = 1, 2, 3, 4 and 5."
    )


SINE = Analysis(
    name="sine",
    reference="Fig. A.11-A.12",
    about="Are sine waves predicted from their parameter?",
    claim="y = sin(10x + b) with b = 1 to 5 as the condition: when generalizing towards s = 1.0, it can be seen that"
    " the correct sine function is predicted.",
    run=_sine,
)
