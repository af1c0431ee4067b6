"""The thesis' Tables II and E.2, in their shape, by their rules: each model a value, a workload as often as models."""

from __future__ import annotations

import msgspec

from services.study.analysis.backgrounds import ASKED
from services.study.analysis.exclusion import Sample
from services.study.analysis.hypotheses import Measure
from services.study.analysis.observations import Observations, in_order
from services.study.analysis.summary import Quartiles
from services.study.analysis.units import of_models

HIGH_FROM = {"gaming": 5, "teleoperation": 4}
"""Of the form's codes of experience, 0 none to 5 more than ten weeks: what Table E.2 calls high, as its numbers of
models tell."""

_MEASURES = (Measure.SECONDS, Measure.WORKLOAD)


class Part(msgspec.Struct, frozen=True):
    """Of Table E.2: one method's values of participants who said the same.

    Attributes:
        background: what is told apart.
        said: what these said: "low" or "high" experience, or their words.
        measure: of which.
        method: by which.
        values: models, N in the table's head.
        quartiles: of them.
    """

    background: str
    said: str
    measure: Measure
    method: str
    values: int
    quartiles: Quartiles


class ThesisTables(msgspec.Struct, frozen=True):
    """What the report adds by the thesis' rules.

    Attributes:
        by_background: Table E.2, for every background that tells two groups or more apart.
    """

    by_background: tuple[Part, ...]


def thesis_tables(observations: Observations) -> ThesisTables:
    """Table E.2; Table II is the summary and the tests."""
    parts: list[Part] = []
    for background in ASKED:
        said = {one.participant: _group(background, str(getattr(one, background))) for one in observations.backgrounds}
        groups = in_order(text for text in said.values() if text)
        if not 2 <= len(groups) <= len(said) // 2:
            continue
        for measure in _MEASURES:
            values = of_models(observations, measure, Sample.PLANNED)
            for method in observations.methods:
                for group in groups:
                    of = [v.value for v in values if v.method == method and said.get(v.participant) == group]
                    if of:
                        parts.append(Part(background, group, measure, method, len(of), Quartiles.of(of)))
    return ThesisTables(tuple(parts))


def _group(background: str, said: str) -> str:
    if background not in HIGH_FROM:
        return said
    try:
        return "high" if float(said) >= HIGH_FROM[background] else "low"
    except ValueError:
        return said
