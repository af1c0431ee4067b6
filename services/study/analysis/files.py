"""The tables that others go on with: tidy, a line an observation, in UTF-8 with commas and points."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from pathlib import Path

import msgspec

from services.process.files import write_file
from services.study.analysis.analysis import Analysis
from services.study.analysis.observations import Background, Observations, Outcome, Rating

NUMBERS = "analysis.json"

Table = tuple[Sequence[str], Iterable[Sequence[object]]]


def write_files(folder: Path, observations: Observations, analysis: Analysis) -> list[Path]:
    """Write the observations and the figures.

    Args:
        folder: is made where it is missing.
        observations: of the study.
        analysis: of them.

    Returns:
        The files: outcomes.csv, ratings.csv, participants.csv, summary.csv, tests.csv and `NUMBERS`.

    Raises:
        CannotWrite: one cannot be written; those before it are there.
    """
    tables = {
        "outcomes.csv": _structs(Outcome, observations.outcomes, observations),
        "ratings.csv": _structs(Rating, observations.ratings, observations),
        "participants.csv": _structs(Background, observations.backgrounds, observations),
        "summary.csv": _summary(analysis),
        "tests.csv": _tests(analysis),
    }
    contents = {name: _text(*table).encode() for name, table in tables.items()}
    contents[NUMBERS] = msgspec.json.format(msgspec.json.encode(analysis)) + b"\n"
    for name, content in contents.items():
        write_file(folder / name, content)
    return [folder / name for name in contents]


def _structs(type_: type[msgspec.Struct], structs: Sequence[msgspec.Struct], observations: Observations) -> Table:
    fields = type_.__struct_fields__
    rows = [[*(getattr(one, name) for name in fields), observations.synthetic] for one in structs]
    return (*fields, "synthetic"), rows


def _summary(analysis: Analysis) -> Table:
    head = (
        "method",
        "measure",
        "sample",
        "values",
        "people",
        "lower_quartile",
        "median",
        "upper_quartile",
        "synthetic",
    )
    rows = [
        (
            *(one.method, one.measure.value, one.sample.value, one.values, one.people),
            *(one.quartiles.lower, one.quartiles.median, one.quartiles.upper, analysis.synthetic),
        )
        for one in analysis.summaries
    ]
    return head, rows


def _tests(analysis: Analysis) -> Table:
    head = (
        *("hypothesis", "measure", "first", "second", "direction", "confirmatory", "sample", "people", "pairs"),
        *("median_first", "median_second", "w_plus", "w_minus", "n", "zeros", "exact", "p", "p_adjusted", "rejected"),
        *("rank_biserial", "rank_biserial_low", "rank_biserial_high", "shift", "shift_low", "shift_high", "synthetic"),
    )
    rows = []
    for one in analysis.results:
        asked, test = one.hypothesis, one.test
        figures = (test.statistic, test.opposite, test.n, test.zeros, test.exact, test.p) if test else (None,) * 6
        rows.append(
            (
                *(asked.name, asked.measure.value, *asked.sides, asked.direction.value, asked.confirmatory),
                *(one.sample.value, one.people, one.pairs, *(one.medians or (None, None)), *figures),
                *(one.adjusted, one.rejected, one.effect.value, one.effect.low, one.effect.high),
                *(one.shift.value, one.shift.low, one.shift.high, analysis.synthetic),
            )
        )
    return head, rows


def _text(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(head)
    for row in rows:
        writer.writerow([_cell(value) for value in row])
    return text.getvalue()


def _cell(value: object) -> object:
    match value:
        case None:
            return ""
        case bool():
            return "yes" if value else "no"
        case str() if value.startswith(("=", "+", "-", "@")):
            return f"'{value}"  # a spreadsheet would take it for a formula
    return value
