"""Linear functions, the first thing that the thesis' implementation was tried on (Appendix A)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from lfd.models.promp import CONDITION_SCALE, ConditionedProMP, PrompOptions
from services.reproduction.analysis import Analysis, Claim, Context, Figure, Finding, Relation, Row, Source, Value
from services.reproduction.functions import TAUGHT, Family, X
from services.reproduction.models import DEFAULT, LEARNT, THESIS, Contender
from services.reproduction.style import DEMONSTRATION_LINE, TRUE_LINE, Line, drawn, panels

Array = NDArray[np.float64]

_LINE = Family("x + b", lambda x, b: x + b)
_LINE_OF_THREE = Family("x + b", lambda x, b: x + b, lambda b: np.full(3, b))
_THREE_LINES = Family("x + b, 2x + b, −x + b", lambda x, b: np.column_stack([x + b, 2.0 * x + b, -x + b]))
_LITTLE_NOISE = 1e-9
_RIGHT = 0.01  # error that cannot be seen in the thesis' plots
_LEFT_OUT, _BEYOND = 3.0, 7.0
_ASKED = np.linspace(-1.0, 8.0, 28)


def shrinkage(noise: float, b: float) -> float:
    """How far the noise of equation (10) draws a prediction of x + b at s = b towards the mean condition.

    With Sigma_ss = 100 var(b), the gain is smaller by 1 / (1 + noise / Sigma_ss).

    Args:
        noise: added to the variance of ten times the condition.
        b: of the prediction.
    """
    variance = 100.0 * float(np.var(TAUGHT, ddof=1))
    return abs(b - float(np.mean(TAUGHT))) * noise / (variance + noise)


def measured_shrinkage(noise: float, b: float) -> float:
    """The same, measured: the largest difference between a prediction with the noise and one with next to none."""
    motions = _LINE.motions()
    with_noise, without = (
        _LINE.predicted(ConditionedProMP.fit(motions, PrompOptions(conditioning_noise=n)), b)
        for n in (noise, _LITTLE_NOISE)
    )
    return float(np.max(np.abs(with_noise - without)))


def _linear(context: Context) -> Finding:
    noise = PrompOptions().conditioning_noise
    return Finding(
        _claims(_LINE, "y = x + 1 is predicted at s = 1: a linear function from 1 to 2."),
        (
            Row("y(0) and y(1) at s = 1", _of_learnt(lambda kind: _ends(_taught(_LINE, kind))), thesis="1 and 2"),
            *_error_rows(_LINE),
            Row("deviation at s = 1 due to 0.03 I alone", {THESIS.name: measured_shrinkage(noise, 1.0)}),
        ),
        context.drawn(lambda: (_predictions_figure(_LINE), _errors_figure(_LINE, context), _shrinkage_figure(noise))),
        (
            "RMSE is over 100 points of x from 0 to 1, without unit. A joint Gaussian holds every function that is"
            " affine in s; what is left is the ten basis functions, which cannot draw a straight line, and the"
            f" conditioning noise, which at s = 1 gives |b − 3| · 0.03 / (250 + 0.03) = {shrinkage(noise, 1.0):.2g}.",
            "Whoever is anchored is told where a motion begins, as a robot always is: here that is b itself.",
        ),
    )


def _linear_3d_context(context: Context) -> Finding:
    odd = np.array([1.0, 3.0, 5.0])

    def taken_for(kind: Contender) -> Value:
        situation = _LINE_OF_THREE.motion(3.0).situation
        asked = type(situation)(odd, situation.origin, situation.start_position, situation.start_orientation)
        y = kind.fit(_LINE_OF_THREE.motions()).predict(asked, len(X)).trajectory.positions[:, 0]
        return float(np.mean(y - X))

    return Finding(
        _claims(_LINE_OF_THREE, "The correct trajectory is generated towards s = [1, 1, 1]."),
        (
            *_error_rows(_LINE_OF_THREE),
            Row("b that s = [1, 3, 5], never taught, is taken for", _of_learnt(taken_for)),
        ),
        context.drawn(lambda: (_predictions_figure(_LINE_OF_THREE), _errors_figure(_LINE_OF_THREE, context))),
        (
            "With s = [b, b, b] the covariance of the condition has rank one, and without the noise of equation (10)"
            " it could not be inverted. A condition off the line is taken for its mean.",
        ),
    )


def _linear_3d_output(context: Context) -> Finding:
    def worst(kind: Contender) -> Value:
        model = kind.fit(_THREE_LINES.motions())
        return float(np.abs(_THREE_LINES.predicted(model, 1.0) - _THREE_LINES.outputs(1.0)).max())

    return Finding(
        _claims(_THREE_LINES, "Each of the outputs is correctly generalised at s = 1."),
        (*_error_rows(_THREE_LINES), Row("largest deviation of any output at s = 1", _of_learnt(worst))),
        context.drawn(lambda: (_predictions_figure(_THREE_LINES), _errors_figure(_THREE_LINES, context))),
        (
            "The thesis does not say which three functions it used; here they are x + b, 2x + b and −x + b. It fits a"
            " model to each output; here one Gaussian is joint over all, with the same mean.",
        ),
    )


def _claims(family: Family, sentence: str) -> tuple[Claim, ...]:
    thesis, default = (kind.fit(family.motions()) for kind in (THESIS, DEFAULT))
    return (
        Claim(Source.THESIS, sentence, "RMSE at s = 1", family.error(thesis, 1.0), Relation.BELOW, _RIGHT),
        Claim(
            Source.RETOUCH,
            "The default model follows a linear trend to s = 7, beyond what was demonstrated.",
            "RMSE at s = 7",
            family.error(default, _BEYOND),
            Relation.BELOW,
            _RIGHT,
        ),
    )


def _of_learnt(of: Callable[[Contender], Value]) -> dict[str, Value]:
    return {kind.name: of(kind) for kind in LEARNT}


def _taught(family: Family, kind: Contender) -> Array:
    """What a model predicts at s = 1, shape (n,)."""
    return family.predicted(kind.fit(family.motions()), 1.0)[:, 0]


def _error_rows(family: Family) -> list[Row]:
    kept = family.motions([b for b in TAUGHT if b != _LEFT_OUT])
    taught = {kind: kind.fit(family.motions()) for kind in LEARNT}
    partly = {kind: kind.fit(kept) for kind in LEARNT}
    return [
        Row(
            "RMSE at s = 1, demonstrated",
            _of_learnt(lambda kind: family.error(taught[kind], 1.0)),
            thesis="“correct”",
            headline=True,
        ),
        Row("RMSE at s = 3, not demonstrated", _of_learnt(lambda kind: family.error(partly[kind], _LEFT_OUT))),
        Row(
            "RMSE at s = 7, extrapolated",
            _of_learnt(lambda kind: family.error(taught[kind], _BEYOND)),
            headline=True,
        ),
    ]


def _ends(y: Array) -> str:
    return f"{y[0]:.3f} and {y[-1]:.3f}"


def _predictions_figure(family: Family) -> Figure:
    motions = family.motions()
    models = [(kind, kind.fit(motions)) for kind in LEARNT]
    values = (1.0, 2.5, _BEYOND)
    titles = ["s = 1, demonstrated", "s = 2.5, between", "s = 7, beyond"]
    canvas, panes = panels(titles)
    for axes, b in zip(panes, values, strict=True):
        for i, taught in enumerate(TAUGHT):
            label = "demonstrations" if i == 0 else None
            lines = axes.plot(X, family.outputs(taught), **DEMONSTRATION_LINE())
            lines[0].set_label(label)
        for kind, model in models:
            axes.plot(X, family.predicted(model, b), **kind.line())[0].set_label(kind.label)
        axes.plot(X, family.outputs(b), **TRUE_LINE())[0].set_label("the function itself")
        axes.set_xlabel("x")
    panes[0].set_ylabel(f"y = {family.name}")
    return drawn(canvas, "predictions", f"Predictions of {family.name} from demonstrations with b = 1 to 5.")


def _errors_figure(family: Family, context: Context) -> Figure:
    canvas, (axes,) = panels([""], height=2.5)
    motions = family.motions()
    for kind in context.track(LEARNT):
        model = kind.fit(motions)
        axes.semilogy(_ASKED, [family.error(model, float(b)) for b in _ASKED], **kind.line(kind.label))
    axes.axvspan(min(TAUGHT), max(TAUGHT), color="#f1f4f7", zorder=0, label="demonstrated range")
    axes.set(xlabel="b of the prediction", ylabel="RMSE")
    return drawn(canvas, "errors", "Error of the predictions over the condition.")


def _shrinkage_figure(noise: float) -> Figure:
    canvas, (axes,) = panels([""], height=2.5)
    factor = CONDITION_SCALE**2
    for shown, label, style in ((noise, "condition times 10", "-"), (noise * factor, "condition as it is", "--")):
        measured = [measured_shrinkage(shown, float(b)) for b in _ASKED]
        axes.plot(_ASKED, measured, **Line(THESIS.line.color, 2.4, style)(f"0.03 I on the {label}"))
        axes.plot(_ASKED, [shrinkage(shown, float(b)) for b in _ASKED], **TRUE_LINE("closed form"))
    axes.set(xlabel="b of the prediction", ylabel="deviation towards the mean")
    caption = "What the conditioning noise of equation (10) alone does to the predictions of the thesis' model."
    return drawn(canvas, "shrinkage", caption)


LINEAR = Analysis(
    name="linear",
    reference="Fig. A.6",
    about="Are linear functions y = x + b predicted from s = b?",
    claim="When we generalize towards s = 1, it is expected that the output will be of the form y = x + 1, being a"
    " linear function starting at 1 and ending at 2. It can be seen that this is indeed the case.",
    run=_linear,
    seconds=0.5,
    person=False,
)
LINEAR_3D_CONTEXT = Analysis(
    name="linear-3d-context",
    reference="Fig. A.7-A.8",
    about="Are linear functions predicted from a condition of three equal numbers?",
    claim="When generalizing towards s = [1.0, 1.0, 1.0] it can be seen that the correct trajectory is generated.",
    run=_linear_3d_context,
    seconds=0.5,
    person=False,
)
LINEAR_3D_OUTPUT = Analysis(
    name="linear-3d-output",
    reference="Fig. A.9-A.10",
    about="Are three outputs predicted from one condition?",
    claim="Each of the demonstrated outputs is correctly generalized at s = 1.0.",
    run=_linear_3d_output,
    seconds=0.5,
    person=False,
)
