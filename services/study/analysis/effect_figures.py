"""How large the differences are, and how sure: the figures of intervals, and of who takes part."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import fill

import numpy as np

from services.reproduction.analysis import Figure
from services.reproduction.style import TRUTH, panels
from services.study.analysis.analysis import Analysis
from services.study.analysis.comparison import Result
from services.study.analysis.exclusion import Sample
from services.study.analysis.figures import finished, from_zero
from services.study.analysis.hypotheses import Measure
from services.study.analysis.observations import Observations
from services.study.analysis.units import of_people, side

_COLORS = {Sample.PLANNED: TRUTH, Sample.ALL: "#0072b2", Sample.RANKED_LAST: "#d55e00", Sample.SUCCEEDED: "#009e73"}
_POINT = "#0072b2"
_APART = 0.2
_ROW = 0.55  # of a hypothesis [inch]
_COLUMNS = 3
_LETTERS = 38  # that fit below a panel of so many columns


def effects(analysis: Analysis) -> Figure | None:
    """Rank-biserial correlations with their intervals, in every sample; None where there are none."""
    shown = [one for one in analysis.results if one.effect.value is not None]
    if not shown:
        return None
    names = list(dict.fromkeys(one.hypothesis.name for one in shown))
    canvas, (pane,) = panels([""], height=0.9 + _ROW * len(names))
    samples = [one for one in Sample if any(result.sample is one for result in shown)]
    for sample in samples:
        of = [one for one in shown if one.sample is sample]
        y = [names.index(one.hypothesis.name) + _APART * _place(shown, one) for one in of]
        color = _COLORS[sample]
        pane.scatter([one.effect.value or 0.0 for one in of], y, s=26, color=color, zorder=3.0, label=sample.value)
        for one, at in zip(of, y, strict=True):
            if one.effect.low is not None and one.effect.high is not None:
                pane.plot([one.effect.low, one.effect.high], [at, at], color=color, linewidth=1.6)
    pane.axvline(0.0, color="#6b7685", linewidth=0.9)
    pane.set(xlim=(-1.05, 1.05), xlabel="matched-pairs rank-biserial correlation", yticks=range(len(names)))
    pane.set_yticklabels([_label(next(one for one in shown if one.hypothesis.name == name)) for name in names])
    pane.set_ylim(len(names) - 0.5, -0.5)
    pane.grid(visible=False, axis="y")
    for between in range(1, len(names)):
        pane.axhline(between - 0.5, color="#e9edf1", linewidth=0.8)
    caption = (
        f"Effect sizes with {100.0 * analysis.plan.confidence:g} % intervals, by sample. −1: everybody has less on the"
        " first side; 0: no more often or more strongly than on the second. No interval where all differences have one"
        " sign."
    )
    return finished(canvas, "effects", caption, synthetic=analysis.synthetic)


def _place(shown: Sequence[Result], one: Result) -> float:
    """Of a sample among those of the same hypothesis, about zero."""
    samples = [other.sample for other in shown if other.hypothesis.name == one.hypothesis.name]
    return samples.index(one.sample) - (len(samples) - 1) / 2.0


def _label(result: Result) -> str:
    first, second = result.hypothesis.sides
    return f"{result.hypothesis.name}\n{first} against {second}"


def backgrounds(observations: Observations, analysis: Analysis) -> list[Figure]:
    """Every participant's mean over methods by what the participant said, a figure a measure."""
    figures = []
    for measure in (Measure.SECONDS, Measure.WORKLOAD):
        found = [one for one in analysis.influences if one.measure is measure and len(one.groups) > 1]
        if not found:
            continue
        values = of_people(observations, measure, Sample.PLANNED)
        rows = -(-len(found) // _COLUMNS)
        canvas, axes = panels([one.background for one in found], height=2.3, rows=rows)
        for pane, one in zip(axes, found, strict=True):
            said = {b.participant: str(getattr(b, one.background)) for b in observations.backgrounds}
            known = {p: side(values, p, analysis.methods) for p in observations.participants if said.get(p)}
            texts = observations.levels(one.background, (said[p] for p, value in known.items() if value is not None))
            if one.scale:
                pairs = [(float(said[p].replace(",", ".")), value) for p, value in known.items() if value is not None]
                pane.scatter([x for x, _ in pairs], [y for _, y in pairs], s=15, color=_POINT, alpha=0.75, linewidths=0)
                from_zero(pane)
                continue
            for x, text in enumerate(texts):
                of = sorted(value for p, value in known.items() if value is not None and said[p] == text)
                pane.scatter(x + np.linspace(-0.1, 0.1, len(of)), of, s=15, color=_POINT, alpha=0.75, linewidths=0)
                pane.plot([x - 0.25, x + 0.25], [np.median(of)] * 2, color=TRUTH, linewidth=2.0)
            # Where they are many their names do not fit: each second one, and so on.
            step = max(1, -(-len(texts) // 8))
            wide = max(6, _LETTERS * step // len(texts))
            labels = [fill(observations.called(one.background, text), wide, max_lines=3) for text in texts]
            pane.set(xticks=range(0, len(texts), step), xticklabels=labels[::step], xlim=(-0.6, len(texts) - 0.4))
            from_zero(pane)
        for pane in axes[::_COLUMNS]:
            pane.set_ylabel(f"{measure.title.split(' (')[0]}{' [s]' if measure.unit else ''}")
        caption = (
            f"{measure.title[0].upper()}{measure.title[1:]} by what participants said of themselves; a point is a"
            " participant's mean over all methods, a bar a group's median."
        )
        figures.append(finished(canvas, f"background-{measure.value}", caption, synthetic=analysis.synthetic))
    return figures
