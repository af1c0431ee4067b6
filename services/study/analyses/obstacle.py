"""An obstacle that appears after training, before via-points in the plane (the thesis' 2D example)."""

from __future__ import annotations

from itertools import product

from services.study import plane, teaching
from services.study.analysis import Analysis, Context, Finding
from sim.scenes.particle import OBSTACLE_TRAINING, PARTICLE, Y_UNIT

_NEEDED = 9  # of the thesis
_SIZES = (20.0, 5.0)
_BEYOND = tuple((a, b) for size in _SIZES for a, b in product((-size, 0.0, size), repeat=2) if a or b)
_FAILED = ((0.0, -20.0), (-20.0, -20.0), (-20.0, 20.0), (0.0, 20.0))  # two of them: the thesis names three pairs


def _obstacle(context: Context) -> Finding:
    demonstrated = [(float(y_1), float(y_2)) for y_1, y_2 in OBSTACLE_TRAINING / Y_UNIT]
    answer = teaching.answered(plane.question(demonstrated, PARTICLE.variants[1], _BEYOND), context)
    return Finding(
        plane.holds(answer, _NEEDED, _FAILED),
        plane.sentence(answer, _NEEDED),
        plane.rows(answer, _NEEDED, len(_BEYOND) - 2),
        (
            plane.demonstrations(answer, "Demonstrations without the obstacle, which they run into (Fig. B.3)."),
            *plane.first_rounds(answer, "Predictions and refinements with the obstacle (Fig. 20)"),
            plane.second_round(answer, "The nine conditions once more, without teaching (Fig. B.4)."),
            plane.beyond(answer, _SIZES, "Conditions that were never taught (Fig. 21, B.5)."),
        ),
        (
            "The text of the thesis names [−20, 20] and [0, 20] as the two conditions that failed, its Fig. 21 and B.5"
            " [0, −20] and [−20, −20], its discussion [0, −20] and [−20, 20].",
            "The thesis gives the obstacle's left edge only. Here it reaches from x = 0.5 to 0.8 and up to y = 2.5, and"
            " the operator leads the particle over it at y = 8 whatever the condition. How high that is decides what"
            " is learnt from few refinements: at y = 5.5 the default model, refined at −10, ran into it at −20.",
            *teaching.notes(answer),
        ),
    )


OBSTACLE = Analysis(
    name="obstacle",
    reference="Fig. 20-21, B.3-B.5",
    about="How many refinements until an obstacle is avoided that appeared after training?",
    claim="With three initial demonstrations the prediction had to be adapted under each of nine conditions, after"
    " which all nine avoid the obstacle. So do all conditions from -20 to 20 and -5 to 5 except two.",
    run=_obstacle,
)
