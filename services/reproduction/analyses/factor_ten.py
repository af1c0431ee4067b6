"""The factor 10 on the condition (Appendix D): what it does, and that it is only a smaller noise."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lfd.models.gaussian import JointGaussian, condition
from lfd.models.model import MovementModel
from lfd.models.promp import CONDITION_SCALE, ConditionedProMP, PrompOptions
from lfd.motion.demonstration import Demonstration
from services.reproduction.analysis import Analysis, Claim, Context, Figure, Finding, Relation, Row, Source
from services.reproduction.models import DEFAULT, THESIS
from services.reproduction.scripted import demonstrate
from services.reproduction.style import ADAPTIVE, CONDITIONED, DEMONSTRATION_LINE, Line, drawn, panels
from sim.tasks import TABLE

Array = NDArray[np.float64]

_AS_FAR = 0.95  # of the demonstrations' spread: the predictions are correct
_NOISE = PrompOptions().conditioning_noise
_WITHOUT = PrompOptions(conditioning_noise=_NOISE * CONDITION_SCALE**2)
"""The thesis' noise on a condition that is not multiplied."""


def identity_error(samples: Array, s: Array, noise: float, factor: float) -> float:
    """How far the two sides of the identity are apart, relative to the larger: a factor on s is noise / factor^2.

    Args:
        samples: of x = [w, s], shape (M, k + c).
        s: the condition, shape (c,).
        noise: on the condition as it is multiplied.
        factor: on the condition.
    """
    k = samples.shape[1] - len(s)
    scaled = np.hstack([samples[:, :k], factor * samples[:, k:]])
    multiplied = condition(JointGaussian.fit(scaled), factor * s, noise)
    plain = condition(JointGaussian.fit(samples), s, noise / factor**2)
    return max(
        float(np.linalg.norm(a - b) / np.linalg.norm(a))
        for a, b in ((multiplied.mean, plain.mean), (multiplied.covariance, plain.covariance))
    )


def _factor_ten(context: Context) -> Finding:
    rng = context.rng()
    motions = [demonstrate(TABLE, position, rng) for position in TABLE.training_positions]
    model = ConditionedProMP.fit(motions)
    samples = np.array([np.append(model.encoding.encode(m), m.condition) for m in motions])
    error = max(identity_error(samples, m.condition, _NOISE, CONDITION_SCALE) for m in motions)
    models: dict[str, MovementModel] = {
        "times 10": model,
        "as it is": ConditionedProMP.fit(motions, _WITHOUT),
        DEFAULT.label: DEFAULT.fit(motions),
    }
    spreads = {name: spread(one, motions) for name, one in models.items()}
    scaled, plain = spreads["times 10"], spreads["as it is"]
    return Finding(
        (
            Claim(
                Source.THESIS,
                "When the input is multiplied by 10, the predictions are correct: as far apart as the demonstrations.",
                "spread over the demonstrations'",
                scaled,
                Relation.AT_LEAST,
                _AS_FAR,
            ),
            Claim(
                Source.THESIS,
                "When it is not, they should be further apart.",
                "spread over the demonstrations'",
                plain,
                Relation.BELOW,
                _AS_FAR,
            ),
        ),
        (
            Row(
                "spread of predicted starts over that of demonstrated starts, with the factor",
                {THESIS.name: scaled},
                thesis="“correct”",
                headline=True,
            ),
            Row(
                "the same without the factor",
                {THESIS.name: plain},
                thesis="“should be further apart”",
                headline=True,
            ),
            Row("largest relative difference between factor 10 and noise / 100", {THESIS.name: error}),
        ),
        context.drawn(lambda: (_figure(motions, models),)),
        (
            "Four motions over the table, with an object at each corner of its region, are predicted again at their"
            " own conditions, as in Fig. D.10. Motions are relative to the object, so what they have to get from the"
            " condition is where they begin. The factor is no property of the condition: the same predictions come from"
            " a noise of 0.0003 and no factor. The default model has none, and is told the start.",
        ),
    )


def spread(model: MovementModel, motions: list[Demonstration]) -> float:
    """How far apart predicted starts are from each other, relative to the object, over how far the real ones are."""
    predicted = np.array([model.predict(m.situation).trajectory.positions[0] - m.origin for m in motions])
    demonstrated = np.array([m.trajectory.positions[0] - m.origin for m in motions])
    return float(np.std(predicted, axis=0).sum() / np.std(demonstrated, axis=0).sum())


def _figure(motions: list[Demonstration], models: dict[str, MovementModel]) -> Figure:
    canvas, panes = panels(["condition times 10, as the thesis", "condition as it is", DEFAULT.label], height=2.3)
    for axes, (name, model) in zip(panes, models.items(), strict=True):
        line = Line(ADAPTIVE if name == DEFAULT.label else CONDITIONED, 1.6)
        for motion in motions:
            shown = motion.trajectory.positions - motion.origin
            axes.plot(shown[:, 1], shown[:, 0], **DEMONSTRATION_LINE("demonstrations"))
            p = model.predict(motion.situation).trajectory.positions - motion.origin
            axes.plot(p[:, 1], p[:, 0], **line(DEFAULT.label if name == DEFAULT.label else THESIS.label))
        axes.set(xlabel="y from the object [m]", aspect="equal")
    panes[0].set_ylabel("x from the object [m]")
    return drawn(canvas, "predictions", "Demonstrations and their predictions from above, relative to the object.")


FACTOR_TEN = Analysis(
    name="factor-ten",
    reference="Fig. D.10",
    about="Why is the condition multiplied by 10?",
    claim="Multiplying the input by 10 was experienced to have better prediction results. When it is not done, the"
    " predictions are not correct, as they should be further apart; when it is, they are.",
    run=_factor_ten,
    seconds=0.2,
    person=False,
)
