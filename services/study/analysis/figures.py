"""The report's figures: every value is in them, a participant is a line."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from services.reproduction.analysis import Figure
from services.reproduction.style import TRUTH, drawn, panels
from services.study.analysis.analysis import Analysis
from services.study.analysis.exclusion import Sample
from services.study.analysis.hypotheses import Measure
from services.study.analysis.learning import in_sequence
from services.study.analysis.observations import Observations
from services.study.analysis.units import Values, of_models, of_people

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Canvas

SYNTHETIC = "SYNTHETIC PARTICIPANTS: no person took part"

_COLORS = ("#0072b2", "#56b4e9", "#d55e00", "#e69f00", "#009e73", "#cc79a7", "#6b4c9a", "#9aa4b1")
_LINE = "#9aa4b1"
_WIDE = 0.30  # of a box, of the distance between two
_SPREAD = 0.18
_HEADROOM = 1.15
_ABOVE = 1.06  # of the largest value, so that what stands for it is whole
_TICKS = 3  # of a logarithmic axis, at least


def color_of(analysis: Analysis, method: str) -> str:
    """One colour for one method."""
    return _COLORS[analysis.methods.index(method) % len(_COLORS)]


def by_method(observations: Observations, analysis: Analysis) -> Figure:
    """Box, points and lines of each measure that people are compared in."""
    measures = [one for one in (Measure.SECONDS, Measure.WORKLOAD) if of_people(observations, one, Sample.PLANNED)]
    return _compared(observations, analysis, measures, "by-method")


def other_ratings(observations: Observations, analysis: Analysis) -> Figure | None:
    """The same of what else was rated; None where nothing was."""
    measures = [
        one for one in (Measure.RAW_TLX, Measure.SUS, Measure.TRUST) if of_people(observations, one, Sample.ALL)
    ]
    return _compared(observations, analysis, measures, "other-ratings") if measures else None


def _compared(observations: Observations, analysis: Analysis, measures: Sequence[Measure], name: str) -> Figure:
    canvas, axes = panels([_titled(one) for one in measures], height=3.4)
    for pane, measure in zip(axes, measures, strict=True):
        values = of_people(observations, measure, Sample.PLANNED)
        _boxes(pane, analysis, values)
        pane.set_ylabel(_axis(measure))
        from_zero(pane)
    caption = (
        "A point is a participant: the median over models, or what was rated; a grey line joins the same participant."
        " Boxes have medians and quartiles, whiskers reach to the last value within one and a half of the box's height."
    )
    return _finished(canvas, analysis, name, caption)


def by_model(observations: Observations, analysis: Analysis) -> Figure:
    """Times of each model, a panel a method."""
    values = of_models(observations, Measure.SECONDS, Sample.ALL)
    excluded = set(analysis.flow.excluded)
    canvas, axes = panels(list(analysis.methods), height=2.9)
    seconds = [one.value for one in values]
    for pane, method in zip(axes, analysis.methods, strict=True):
        of = {(one.participant, one.model): one.value for one in values if one.method == method}
        for participant in observations.participants:
            course = [(model, of[participant, model]) for model in analysis.models if (participant, model) in of]
            out = participant in excluded
            if course:
                x, y = zip(*course, strict=True)
                style = (0.0, (2.0, 2.0)) if out else "-"
                pane.plot(x, y, color=_LINE, linewidth=0.7, linestyle=style, zorder=1.5)
                face = "white" if out else color_of(analysis, method)
                pane.scatter(x, y, s=13, color=face, edgecolors=color_of(analysis, method), linewidths=0.8, zorder=3.0)
        for model in analysis.models:
            _box(
                pane,
                model,
                [v for (p, m), v in of.items() if m == model and p not in excluded],
                color_of(analysis, method),
            )
        pane.set(xlabel="model", xticks=list(analysis.models), xlim=_around(len(analysis.models), analysis.models[0]))
        pane.set_yscale("log")
        pane.set_yticks(*round_times(min(seconds), max(seconds)), minor=False)
        pane.minorticks_off()
        pane.set_ylim(min(seconds) / _HEADROOM, max(seconds) * _HEADROOM)
    axes[0].set_ylabel(_axis(Measure.SECONDS))
    caption = (
        "Refinement time of every model that was adapted, on a logarithmic axis. Filled: participants who are in the"
        " analysis, the boxes are theirs; open, on dashed lines: who is excluded from it."
    )
    return _finished(canvas, analysis, "by-model", caption)


def adaptation(observations: Observations, analysis: Analysis) -> Figure:
    """What became of the models, and what it took to adapt them."""
    measures = [one for one in (Measure.REFINEMENTS, Measure.UPDATES) if of_people(observations, one, Sample.ALL)]
    canvas, axes = panels(["models", *(f"{one.value} of an adapted model" for one in measures)], height=2.8)
    at = list(range(len(analysis.methods)))
    parts = {
        "adapted": ([cell.adapted for cell in analysis.flow.cells], "#009e73"),
        "not adapted": ([cell.failed for cell in analysis.flow.cells], "#d55e00"),
        "not attempted": ([cell.untouched for cell in analysis.flow.cells], "#c3cad3"),
        "invalid": ([cell.invalid for cell in analysis.flow.cells], "#c9a227"),
    }
    below = np.zeros(len(at))
    for label, (counts, color) in parts.items():
        if any(counts):
            axes[0].bar(at, counts, 0.6, bottom=below, color=color, label=label)
            for x, bottom, count in zip(at, below, counts, strict=True):
                if count:
                    axes[0].text(x, bottom + count / 2.0, str(count), ha="center", va="center", fontsize=7.5)
            below += np.array(counts)
    axes[0].set(xticks=at, xticklabels=_ticks(analysis))
    from_zero(axes[0], whole=True)
    for pane, measure in zip(axes[1:], measures, strict=True):
        values = of_models(observations, measure, Sample.PLANNED)
        for x, method in enumerate(analysis.methods):
            of = [one.value for one in values if one.method == method]
            _box(pane, x, of, color_of(analysis, method))
            pane.scatter(
                x + _jitter(of), of, s=9, color=color_of(analysis, method), alpha=0.6, linewidths=0.0, zorder=3.0
            )
        pane.set(xticks=at, xticklabels=_ticks(analysis), xlim=_around(len(at)))
        from_zero(pane, whole=True)
    caption = (
        "Left: what became of all models of all participants; a model is not attempted where there was no refinement of"
        " it. Right: refinements and updates of each adapted model of the participants in the analysis."
    )
    return _finished(canvas, analysis, "adaptation", caption)


def learning(observations: Observations, analysis: Analysis) -> Figure | None:
    """Times in sequence, and how attempts ended; None where nothing was in sequence."""
    titles = [f"from {course.over} to {course.over}" for course in analysis.courses]
    titles += ["from attempt to attempt"] if analysis.attempts else []
    if not titles:
        return None
    canvas, axes = panels(titles, height=2.8)
    values = of_models(observations, Measure.SECONDS, Sample.PLANNED)
    for pane, course in zip(axes, analysis.courses, strict=False):
        times = in_sequence(values, course.over)
        for participant in observations.participants:
            shown = [(n, times[participant, n]) for n in course.medians if (participant, n) in times]
            if shown:
                pane.plot(*zip(*shown, strict=True), color=_LINE, linewidth=0.8)
        medians = sorted(course.medians.items())
        pane.plot(*zip(*medians, strict=True), "o-", color=TRUTH, linewidth=2.0, markersize=5.0, label="median")
        label = "time / method's median" if course.relative else _axis(Measure.SECONDS)
        pane.set(xlabel=course.over, ylabel=label, xticks=list(course.medians))
        from_zero(pane)
    if analysis.attempts:
        _attempts(axes[-1], analysis)
    caption = "Grey: participants, their median over all methods."
    if analysis.attempts:
        caption += (
            " Attempts: share that succeeded, with Wilson's interval, which takes attempts of one person for"
            " independent ones; who has succeeded goes on, so that later attempts are of those who had more difficulty."
        )
    return _finished(canvas, analysis, "learning", caption)


def _attempts(pane: Axes, analysis: Analysis) -> None:
    for i, method in enumerate(analysis.methods):
        of = [one for one in analysis.attempts if one.method == method]
        if of:
            x = np.array([one.number for one in of]) + 0.06 * (i - len(analysis.methods) / 2.0)
            share = np.array([one.successes / one.attempts for one in of])
            bounds = np.array([one.proportion.interval for one in of]).T
            errors = np.abs(bounds - share)
            color = color_of(analysis, method)
            pane.errorbar(
                x, share, errors, fmt="o-", color=color, markersize=3.5, linewidth=1.2, elinewidth=0.7, label=method
            )
    numbers = sorted({one.number for one in analysis.attempts})
    # Of many, every so many-th: what is between two attempts is none.
    shown = numbers[:: 1 + len(numbers) // 10]
    pane.set(xlabel="attempt at a model", ylabel="succeeded", xticks=shown, ylim=(-0.05, 1.05))


def _boxes(pane: Axes, analysis: Analysis, values: Values) -> None:
    """A box a method, its participants' values beside each other, joined from method to method."""
    people = sorted({participant for participant, _ in values})
    columns = {method: [values.get((p, method)) for p in people] for method in analysis.methods}
    offsets = {m: dict(zip(people, _jitter([v or 0.0 for v in columns[m]]), strict=True)) for m in analysis.methods}
    for p in people:
        course = [(x + offsets[m][p], values[p, m]) for x, m in enumerate(analysis.methods) if (p, m) in values]
        pane.plot(*zip(*course, strict=True), color=_LINE, linewidth=0.6, alpha=0.7, zorder=1.5)
    for x, method in enumerate(analysis.methods):
        of = [(x + offsets[method][p], values[p, method]) for p in people if (p, method) in values]
        _box(pane, x, [value for _, value in of], color_of(analysis, method))
        xs, ys = [x for x, _ in of], [y for _, y in of]
        pane.scatter(xs, ys, s=16, color=color_of(analysis, method), linewidths=0.0, zorder=3.0)
    pane.set(xticks=range(len(analysis.methods)), xticklabels=_ticks(analysis), xlim=_around(len(analysis.methods)))


def _box(pane: Axes, x: float, values: Sequence[float], color: str) -> None:
    if not values:
        return
    pane.boxplot(
        [list(values)],
        positions=[x],
        widths=2.0 * _WIDE,
        showfliers=False,
        patch_artist=True,
        manage_ticks=False,
        boxprops={"facecolor": f"{color}22", "edgecolor": color, "linewidth": 1.0},
        medianprops={"color": color, "linewidth": 2.2},
        whiskerprops={"color": color, "linewidth": 1.0},
        capprops={"color": color, "linewidth": 1.0},
        zorder=2.0,
    )


def _jitter(values: Sequence[float]) -> NDArray[np.float64]:
    """Beside each other by the golden ratio, in the order of the values: neighbours are apart, and always the same."""
    ranks = np.argsort(np.argsort(values, kind="stable"), kind="stable")
    return np.asarray(_SPREAD * (2.0 * np.mod(ranks * 0.6180339887, 1.0) - 1.0), dtype=np.float64)


def round_times(low: float, high: float) -> tuple[list[float], list[str]]:
    """Round numbers among times, for a logarithmic axis, and their labels: the coarsest of which there are enough."""
    first, last = low / _HEADROOM, high * _HEADROOM
    steps = [
        [digit * 10.0**power for power in range(-1, 6) for digit in digits]
        for digits in ((1.0, 2.0, 5.0), (1.0, 1.5, 2.0, 3.0, 5.0, 7.0))
    ]
    # Times that are close to each other: multiples of a round number.
    size = 10.0 ** np.floor(np.log10(last - first))
    steps += [(share * size * np.arange(1.0, last / (share * size) + 1.0)).tolist() for share in (1.0, 0.5, 0.2)]
    among = ([one for one in of if first <= one <= last] for of in steps)
    ticks = next(of for of in among if len(of) >= _TICKS)
    return ticks, [f"{one:g}" for one in ticks]


def _ticks(analysis: Analysis) -> list[str]:
    return list(analysis.methods)


def _around(count: int, first: float = 0.0) -> tuple[float, float]:
    return first - 0.6, first + count - 0.4


def _axis(measure: Measure) -> str:
    return f"{measure.title} [{measure.unit}]" if measure.unit else measure.title


def from_zero(pane: Axes, *, whole: bool = False) -> None:
    """Let what is drawn stand on zero, with room above the largest value.

    Args:
        pane: with all that it has.
        whole: the values are counts: between two of them is no tick.
    """
    top = pane.dataLim.y1
    pane.set_ylim(0.0, _ABOVE * top if top > 0.0 else 1.0)
    if whole:
        from matplotlib.ticker import MaxNLocator  # noqa: PLC0415 - see services.reproduction.style

        pane.yaxis.set_major_locator(MaxNLocator("auto", steps=(1, 2, 5, 10), integer=True))


def _titled(measure: Measure) -> str:
    return measure.title[0].upper() + measure.title[1:]


def _finished(canvas: Canvas, analysis: Analysis, name: str, caption: str) -> Figure:
    return finished(canvas, name, caption, synthetic=analysis.synthetic)


def finished(canvas: Canvas, name: str, caption: str, *, synthetic: bool) -> Figure:
    """A figure, marked where no person took part."""
    if synthetic:
        canvas.suptitle(
            "SYNTHETIC PARTICIPANTS: no person took part", color="#c62a2f", fontsize=8.0, x=0.995, ha="right"
        )
    return drawn(canvas, name, ("Synthetic participants. " if synthetic else "") + caption)
