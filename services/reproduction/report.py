"""The report: one HTML file that needs nothing else, neither network nor folder."""

from __future__ import annotations

import base64
import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import version
from pathlib import Path

import jinja2
import numpy as np

from services.process.files import write_whole
from services.reproduction.analysis import Analysis, Source
from services.reproduction.exceptions import CannotKeep
from services.reproduction.models import CONTENDERS, Contender
from services.reproduction.numerals import bounded, interval, shown
from services.reproduction.store import Done, Failed, Record, Run, is_svg
from services.reproduction.summary import Holds, Judgement, Summary, summarised
from services.reproduction.work import pieces_of

REPORT = "report.html"


@dataclass(frozen=True)
class Entry:
    """What there is of an analysis.

    Attributes:
        analysis: that it is about.
        wanted: runs in all.
        summary: of those that are done; None where there is none.
        failures: reasons of those that failed, each once.
        failed: how many did.
    """

    analysis: Analysis
    wanted: int
    summary: Summary | None
    failures: tuple[str, ...]
    failed: int

    @classmethod
    def of(cls, analysis: Analysis, records: Mapping[Run, Record], seeds: Sequence[int]) -> Entry:
        """From the records of any runs.

        Args:
            analysis: whose entry it is.
            records: of its runs, and of others.
            seeds: of the people.
        """
        runs = [piece.run for piece in pieces_of(analysis, seeds)]
        there = [records[run] for run in runs if run in records]
        done = [record for record in there if isinstance(record, Done)]
        reasons = [record.reason for record in there if isinstance(record, Failed)]
        findings = [record.finding for record in done]
        summary = summarised(analysis, findings, sum(record.seconds for record in done)) if done else None
        return cls(analysis, len(runs), summary, tuple(dict.fromkeys(reasons)), len(reasons))

    @property
    def judgements(self) -> tuple[Judgement, ...]:
        """Of its claims; none before a run is done."""
        return self.summary.judgements if self.summary else ()

    @property
    def compared(self) -> list[Contender]:
        """The models to whom any question of it arises."""
        named = {name for row in (self.summary.rows if self.summary else ()) for name in row.cells}
        return [contender for contender in CONTENDERS if contender.name in named]

    @property
    def complete(self) -> bool:
        """All its runs are done."""
        return self.summary is not None and (self.summary.people or 1) == self.wanted


def counts(entries: Sequence[Entry], holds: Holds, source: Source | None = None) -> int:
    """Claims of all analyses of which that was found, of anybody or of one source."""
    return sum(entry.summary.count(holds, source) for entry in entries if entry.summary)


def write_report(folder: Path, entries: Sequence[Entry], seeds: Sequence[int]) -> Path:
    """Write what has come out so far.

    Args:
        folder: of the report.
        entries: of all analyses there are, in the order of the report.
        seeds: of the people.

    Returns:
        The file.

    Raises:
        CannotKeep: the folder cannot be written.
    """
    path = folder / REPORT
    try:
        write_whole(path, html(entries, seeds).encode())
    except OSError as error:
        raise CannotKeep(folder, error.strerror or str(error)) from None
    return path


def html(entries: Sequence[Entry], seeds: Sequence[int]) -> str:
    """The report as text, see `write_report`."""
    return _template().render(
        entries=entries,
        verdicts=[
            (holds, [(source, counts(entries, holds, source)) for source in Source], counts(entries, holds))
            for holds in Holds
        ],
        contrary=[(entry, one) for entry in entries for one in entry.judgements if one.holds is Holds.NO],
        failed=sum(entry.failed for entry in entries),
        missing=sum(entry.summary is None for entry in entries),
        contenders=CONTENDERS,
        people=len(seeds),
        first_seed=seeds[0],
        made=f"{datetime.now(UTC):%d %B %Y, %H:%M} UTC",
        versions=f"Python {platform.python_version()}, NumPy {np.__version__}, Matplotlib {version('matplotlib')}",
    )


@cache
def _template() -> jinja2.Template:
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"shown": shown, "interval": interval, "bounded": bounded, "address": address}
    return environment.get_template("report.html.jinja")


def address(image: bytes) -> str:
    """An image as an address that carries it."""
    kind = "svg+xml" if is_svg(image) else "png"
    return f"data:image/{kind};base64,{base64.b64encode(image).decode()}"
