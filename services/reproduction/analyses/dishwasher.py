"""A basket that was pulled out after training, under an object anywhere across it (dishwasher analysis 1)."""

from __future__ import annotations

import numpy as np

from services.offline.result import Arrangement
from services.reproduction import teaching
from services.reproduction.analysis import Analysis, Context, Finding
from services.reproduction.teaching import Question
from services.reproduction.teaching_figures import first_rounds, second_round
from sim.tasks import DISHWASHER

_NEEDED = 2  # of the thesis
_CONDITIONS = 4
_PART = ((0.38, -0.16, 0.40), (0.98, 0.30, 0.82))  # [m] of space that is drawn


def question() -> Question:
    """Of the analysis."""
    (x0, y0, z), (x1, y1, _) = DISHWASHER.region.lower, DISHWASHER.region.upper
    places = [((x0 + x1) / 2, float(y), z) for y in np.linspace(y1, y0, _CONDITIONS)]  # in the order of Fig. 23
    trained, changed = DISHWASHER.variants
    refined = tuple(Arrangement(changed, place) for place in places)
    demonstrated = tuple(Arrangement(trained, place) for place in (places[0], places[-1]))
    return Question(DISHWASHER, demonstrated, refined, refined)


def _dishwasher(context: Context) -> Finding:
    asked = question()
    answer = teaching.answered(asked, context)
    titles = [f"{i}: object at y = {one.place[1]:.2f} m" for i, one in enumerate(asked.refined, 1)]
    y1, y0 = (asked.refined[i].place[1] for i in (0, -1))
    thesis = (
        teaching.few_needed(answer, "Refinements are only necessary for two of the four object positions.", _NEEDED),
        teaching.reached_again(answer, "In a second iteration the predictions succeed across all four."),
    )
    return Finding(
        teaching.claims(answer, thesis),
        teaching.rows(answer, _NEEDED),
        context.drawn(
            lambda: (
                *first_rounds(answer, _PART, titles, "Predictions and refinements in basket position b2 (Fig. 23)"),
                second_round(
                    answer, _PART, "The same conditions once more (Fig. B.13), and the demonstrations (B.11)."
                ),
            )
        ),
        (
            f"The object stands at four places across the basket, from y = {y1:.2f} to {y0:.2f} m: {y1 - y0:.2f} m, in"
            " the thesis' order. The motions to the outer two were demonstrated in basket position b1.",
            *teaching.notes(answer),
        ),
    )


DISHWASHER_BASKET = Analysis(
    name="dishwasher",
    reference="Fig. 23, B.11-B.13",
    about="How many refinements until the pulled-out basket is avoided wherever the object stands?",
    claim="Of four object positions in basket position b2, refinements were only necessary for the first two, after"
    " which the model was able to make correct predictions for the other two. In a second iteration the model generates"
    " successful predictions across all four.",
    run=_dishwasher,
    seconds=140.0,
)
