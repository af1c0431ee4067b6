"""Objects all over a table, of which three positions are demonstrated."""

from __future__ import annotations

from itertools import product

import numpy as np

from services.offline.result import Arrangement
from services.reproduction import teaching
from services.reproduction.analysis import Analysis, Context, Finding
from services.reproduction.teaching import Question
from services.reproduction.teaching_figures import first_rounds, second_round
from sim.tasks import TABLE

_NEEDED = 2  # of the thesis
_DEMONSTRATED = ((0, 1), (2, 2), (2, 0))  # rows along x and columns along y of the grid, as in the thesis
_REFINED = ((2, 1), (1, 2), (1, 1), (1, 0), (0, 2), (0, 0))
_PART = ((0.52, -0.40, 0.62), (0.98, 0.32, 0.92))  # [m] of space that is drawn


def question() -> Question:
    """Of the analysis."""
    (x0, y0, z), (x1, y1, _) = TABLE.region.lower, TABLE.region.upper
    xs, ys = np.linspace(x0, x1, 3).tolist(), np.linspace(y0, y1, 3).tolist()
    clear = TABLE.variants[0]
    grid = {(i, j): Arrangement(clear, (xs[i], ys[j], z)) for i, j in product(range(3), repeat=2)}
    demonstrated, refined = (tuple(grid[place] for place in places) for places in (_DEMONSTRATED, _REFINED))
    return Question(TABLE, demonstrated, refined, (*demonstrated, *refined))


def _table(context: Context) -> Finding:
    asked = question()
    answer = teaching.answered(asked, context)
    titles = [f"{i}: object at ({one.place[0]:.2f}, {one.place[1]:.2f}) m" for i, one in enumerate(asked.refined, 1)]
    width, depth = (upper - lower for lower, upper in zip(TABLE.region.lower[:2], TABLE.region.upper[:2], strict=True))
    thesis = (
        teaching.few_needed(answer, "Refinements are needed for two of the six new object positions.", _NEEDED),
        teaching.reached_again(answer, "In a second iteration each of the nine predictions is successful."),
    )
    return Finding(
        teaching.claims(answer, thesis),
        teaching.rows(answer, _NEEDED),
        context.drawn(
            lambda: (
                *first_rounds(answer, _PART, titles, "Predictions and refinements on the table (Fig. 22)"),
                second_round(answer, _PART, "All nine conditions once more (Fig. B.10), and the demonstrations (B.9)."),
            )
        ),
        (
            f"The object stands on a grid of three by three places, {width:.2f} m along x and {depth:.2f} m along y (in"
            " the thesis 0.20 and 0.40 m); the same three of them were demonstrated as in the thesis.",
            *teaching.notes(answer),
        ),
    )


TABLE_OBJECTS = Analysis(
    name="table",
    reference="Fig. 22, B.9-B.10",
    about="How many refinements until objects all over the table are reached?",
    claim="Of six new object positions, refinements were needed for two, as the object was kicked over and not reached."
    " In a second iteration across all nine object positions each prediction was successful.",
    run=_table,
    seconds=70.0,
)
