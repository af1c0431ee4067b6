"""Sine waves: what a joint Gaussian of weights and condition can predict, and what it cannot (Appendix A)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from services.reproduction.analysis import Analysis, Claim, Context, Figure, Finding, Relation, Row, Source
from services.reproduction.functions import TAUGHT, Family, X, rms
from services.reproduction.models import DEFAULT, FINE, LEARNT, THESIS, Contender
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
    models = {kind: {f: kind.fit(f.motions()) for f in (PHASE, OFFSET, TURNED)} for kind in LEARNT}

    def error(kind: Contender, family: Family, b: float) -> float:
        return family.error(models[kind][family], b)

    questions = [
        ("RMSE of sin(10x + b) at s = b = 1, demonstrated", "“correct”", PHASE, 1.0),
        ("the same at s = b = 2.5, between", None, PHASE, _BETWEEN),
        ("RMSE of sin(10x) + b at s = b = 1, demonstrated", "“correct”", OFFSET, 1.0),
        ("the same at s = b = 2.5, between", None, OFFSET, _BETWEEN),
        ("RMSE of sin(10x + b) at s = [cos b, sin b], b = 1", None, TURNED, 1.0),
        ("the same at b = 2.5, between", None, TURNED, _BETWEEN),
    ]
    rows = [
        Row(said, {kind.name: error(kind, f, b) for kind in LEARNT}, thesis=text, headline=text is not None)
        for said, text, f, b in questions
    ]
    limit = rms(best_affine(PHASE, 1.0) - PHASE.outputs(1.0))
    rows.insert(2, Row("least RMSE of any joint Gaussian for sin(10x + b) at s = 1", {THESIS.name: limit}))
    return Finding(
        (
            Claim(
                Source.THESIS,
                "The correct sine function sin(10x + b) is predicted towards s = 1.",
                "RMSE at s = 1",
                error(THESIS, PHASE, 1.0),
                Relation.BELOW,
                _RIGHT,
            ),
            Claim(
                Source.RETOUCH,
                "It is so for sin(10x) + b, which may have been meant.",
                "RMSE of the thesis' model at s = 1",
                error(THESIS, OFFSET, 1.0),
                Relation.BELOW,
                _RIGHT,
            ),
            Claim(
                Source.RETOUCH,
                "The default model predicts sin(10x + b) where it was demonstrated.",
                "RMSE at s = 1",
                error(DEFAULT, PHASE, 1.0),
                Relation.BELOW,
                _RIGHT,
            ),
            Claim(
                Source.RETOUCH,
                "Between what was demonstrated it comes nearer to sin(10x + b) than the thesis' model with the same"
                " start anchor and resolution.",
                "RMSE at s = 2.5",
                error(DEFAULT, PHASE, _BETWEEN),
                Relation.BELOW,
                error(FINE, PHASE, _BETWEEN),
                against=FINE.label,
            ),
        ),
        tuple(rows),
        context.drawn(lambda: (_predictions_figure(), _errors_figure(context))),
        (
            "sin(10x + b) is not affine in b, and equation (8) is: the best that it can do is the least-squares fit of"
            " the demonstrations by functions that are affine in b; the conditioning noise adds almost nothing.",
            "Between waves whose phases are one radian apart any model can only blend them, unless the condition says"
            " what kind of motion it is, as s = [cos b, sin b] does.",
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
        for kind in LEARNT:
            axes.plot(X, family.predicted(kind.fit(family.motions()), b), **kind.line(kind.label))
        axes.plot(X, family.outputs(b), **TRUE_LINE("the function itself"))
        axes.set(xlabel="x", ylabel="y")
    return drawn(canvas, "predictions", "Predictions of sine waves from demonstrations with b = 1 to 5.")


def _errors_figure(context: Context) -> Figure:
    values = np.linspace(0.0, 6.0, 31)
    canvas, panes = panels(["sin(10x + b), s = b", "sin(10x + b), s = [cos b, sin b]"], height=2.5)
    questions = [(axes, f, kind) for axes, f in zip(panes, (PHASE, TURNED), strict=True) for kind in LEARNT]
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
    seconds=0.6,
    person=False,
)
