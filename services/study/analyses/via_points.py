"""Via-points in the plane, taught at one condition and refined under nine (the thesis' 2D example)."""

from __future__ import annotations

from itertools import product

from services.study import plane, teaching
from services.study.analysis import Analysis, Context, Finding
from sim.scenes.particle import PARTICLE, Y_UNIT

_NEEDED = 4  # of the thesis
_SIZES = (20.0, 15.0, 5.0)
_BEYOND = tuple((a, b) for size in _SIZES for a, b in product((-size, size), repeat=2))


def _via_points(context: Context) -> Finding:
    free = PARTICLE.variants[0]
    answer = teaching.answered(plane.question([(0.0, 0.0)], free, _BEYOND), context)
    return Finding(
        plane.holds(answer, _NEEDED),
        plane.sentence(answer, _NEEDED),
        plane.rows(answer, _NEEDED, len(_BEYOND)),
        (
            plane.learning_curve(answer, "Equation (25) while the nine conditions are observed (Fig. 18, top)."),
            *plane.first_rounds(answer, "Predictions and refinements under the nine conditions (Fig. 18, bottom)"),
            plane.second_round(answer, "The nine conditions once more, without teaching (Fig. B.1)."),
            plane.beyond(answer, _SIZES, "Conditions that were never taught (Fig. 19, B.2)."),
        ),
        (
            "The model starts from one demonstration at s = [0, 0], which is also one of the nine conditions. The"
            " thesis judges by eye whether a via-point is reached; here a motion may pass it at a distance of"
            f" {PARTICLE.tolerance / Y_UNIT:.0f} unit of y at most, the ring that is drawn. Errors are in the thesis'"
            " units of y.",
            *teaching.notes(answer),
        ),
    )


VIA_POINTS = Analysis(
    name="via-points",
    reference="Fig. 18-19, B.1-B.2",
    about="How many refinements until a particle passes through its via-points wherever they stand?",
    claim="After observing and adapting the prediction of four conditions, the mean square error was zero for all"
    " upcoming ones. Predictions for every condition, those from -20 to +20 and -5 to +5 included, reach the"
    " via-points.",
    run=_via_points,
)
