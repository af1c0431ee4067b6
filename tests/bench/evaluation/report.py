"""The benchmark's text: one table a question."""

from dataclasses import dataclass

import numpy as np
from rich.table import Table
from rich.text import Text

from tests.bench.baselines.models import DEFAULT, MODELS
from tests.bench.evaluation.parts import Recordings
from tests.bench.evaluation.refinements import EVERYBODY, ONE
from tests.bench.evaluation.summary import DEGENERATE, bests, first_shares, means, next_gaps


@dataclass(frozen=True)
class Measured:
    """Everything that was measured: on which recordings, and on which of all the options may have been chosen."""

    part: str
    chosen: Recordings
    tuned_on: Recordings
    adaptations: list
    transfers: list
    left_out: list


def show(console, measured, figures):
    """All tables, to a rich console without markup: units stand in brackets."""
    adaptations, transfers, left_out = measured.adaptations, measured.transfers, measured.left_out
    console.print(f"Measured, part {measured.part}: {_named(measured.chosen)}.")
    console.print(f"Options may have been chosen on {_named(measured.tuned_on)}; all else is for reporting only.")
    if left_out:
        for error, asked in (
            ("time", "How far at equal times is a prediction at a condition that was left out? [m]"),
            ("path", "How far is its path, whatever the time? [m]"),
            ("end", "How far does it end? [m]"),
            ("coverage", "How many coordinates lie inside the model's own 90 % intervals? [-]"),
        ):
            console.print(_by_set(left_out, error, asked))
        console.print(
            "Each condition is left out once; means over the demonstrations; bold: least; *: a set of two conditions."
        )
        console.print(_bests(left_out), _means(left_out))
    if adaptations:
        console.print(_corrections(adaptations))
        console.print(
            "Each operator's sequences are replayed from the initial model; next: all corrections but first ones."
        )
    if transfers:
        console.print(_transfers(transfers))
        console.print(
            "First corrections, from the initial model; worse: the share of those of which more than all is left."
            " One: after one of another person, at the same condition; all: after those of everybody else."
        )
    console.print(_figures(figures))


def _named(recordings):
    sets, operators = ", ".join(recordings.sets) or "none", ", ".join(recordings.operators) or "nobody"
    return f"the sets {sets} and the refinements of {operators}"


def _by_set(left_out, error, asked):
    names = list(dict.fromkeys(r.name for r in left_out))
    values = {(r.model, r.name): getattr(r, error) for r in left_out}
    few = {r.name for r in left_out if r.conditions <= DEGENERATE}
    counted = {r.name: f"{r.conditions} / {r.demonstrations}" for r in left_out}
    table = Table(title=asked)
    table.add_column("set", no_wrap=True)
    table.add_column("conditions / motions", width=12)
    for model in MODELS:
        table.add_column(model, width=9)
    for name in names:
        row = [values[m, name] for m in MODELS]
        table.add_row(name + "*" * (name in few), counted[name], *_marked(row, error == "coverage"))
    return table


def _bests(left_out):
    table = Table(
        "set", "error", "best baseline", "its [m]", "default [m]", "ratio", title="Is it worse than the best?"
    )
    for error in ("time", "path"):
        for b in bests(left_out, error):
            table.add_row(b.name, error, b.best_model, f"{b.best:.4f}", f"{b.default:.4f}", f"{b.ratio:.3f}")
    return table


def _means(left_out):
    title = f"Mean over the sets / over those of more than {DEGENERATE} conditions [m]"
    table = Table("model", "time", "path", "end", title=title)
    for m in means(left_out):
        pairs = ((m.time, m.time_of_several), (m.path, m.path_of_several), (m.end, m.end_of_several))
        table.add_row(m.model, *(f"{a:.4f} / {'-' if b is None else f'{b:.4f}'}" for a, b in pairs))
    return table


def _corrections(adaptations):
    columns = (
        "model",
        "first gap [m]",
        "left after it [-]",
        "nine in ten [-]",
        "next gap [m]",
        "nine in ten [m]",
        "next",
    )
    table = Table(*columns, title="How much do a person's own corrections leave, and how far is the next? (medians)")
    for model in MODELS:
        firsts = [a.before[0] for a in adaptations if a.model == model]
        left, following = first_shares(adaptations, model), next_gaps(adaptations, model)
        cells = [np.median(firsts), np.median(left), np.quantile(left, 0.9)]
        if len(following):
            cells += [np.median(following), np.quantile(following, 0.9)]
        table.add_row(model, *(f"{x:.3f}" for x in cells), *[""] * (5 - len(cells)), str(len(following)))
    return table


def _transfers(transfers):
    table = Table(title="How much do others' corrections leave of a person's gap? [-]")
    table.add_column("model", no_wrap=True)
    for taught in ("one", "all"):
        for column in ("median", "nine in ten", "worse", "counted"):
            table.add_column(f"{taught}: {column}", width=9)
    by = {(t.model, t.taught): t for t in transfers}
    for model in dict.fromkeys(t.model for t in transfers):
        cells = []
        for taught in (ONE, EVERYBODY):
            t = by.get((model, taught))
            cells += [f"{t.median:.3f}", f"{t.nine_in_ten:.3f}", f"{t.worse:.1%}", str(t.pairs)] if t else [""] * 4
        table.add_row(model, *cells)
    return table


def _figures(figures):
    table = Table("figure", DEFAULT, "thesis", "best baseline", "", "goal", "", title="What the default model reaches")
    for f in figures:
        best = f"{f.best:.4f} {f.best_model}"
        table.add_row(f.name, f"{f.default:.4f}", f"{f.thesis:.4f}", best, f.unit, f.goal, "met" if f.met else "MISSED")
    return table


def _marked(values, is_coverage):
    if is_coverage:
        return [f"{x:.2f}" for x in values]
    return [Text(f"{x:.4f}", style="bold" if x == min(values) else "") for x in values]
