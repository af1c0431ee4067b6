"""The report: one HTML file that needs nothing else, neither network nor folder."""

from __future__ import annotations

import base64
import platform
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Literal

import jinja2
import matplotlib as mpl
import numpy as np

from services.process.files import write_whole
from services.reproduction.analysis import Analysis, Holds, Value
from services.reproduction.exceptions import CannotKeep
from services.reproduction.store import Done, Failed, Outcome, is_svg
from services.reproduction.style import ADAPTIVE, CONDITIONED

REPORT = "report.html"

State = Literal["yes", "no", "differs", "failed", "missing"]

_WORDS: dict[State, str] = {
    "yes": "confirmed",
    "differs": "differs",
    "no": "not confirmed",
    "failed": "failed",
    "missing": "not run",
}
_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_DIGITS = 3
_NOTHING = 1e-9  # of any unit that a length, an angle or a time is given in here: rounding, not a measurement


def write_report(folder: Path, analyses: Sequence[Analysis], outcomes: Mapping[str, Outcome], seed: int) -> Path:
    """Write what has come out so far.

    Args:
        folder: of the report.
        analyses: all there are, in the order of the report.
        outcomes: by name of the analysis, of those that have one.
        seed: that they ran with.

    Returns:
        The file.

    Raises:
        CannotKeep: the folder cannot be written.
    """
    path = folder / REPORT
    try:
        write_whole(path, html(analyses, outcomes, seed).encode())
    except OSError as error:
        raise CannotKeep(folder, error.strerror or str(error)) from None
    return path


def html(analyses: Sequence[Analysis], outcomes: Mapping[str, Outcome], seed: int) -> str:
    """The report as text, see `write_report`."""
    entries = [(analysis, outcomes.get(analysis.name)) for analysis in analyses]
    states = [state(outcome) for _, outcome in entries]
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"shown": shown, "state": state, "address": address}
    return environment.get_template("report.html.jinja").render(
        entries=entries,
        counts=[(key, word, states.count(key)) for key, word in _WORDS.items() if key in states],
        words=_WORDS,
        colours={"conditioned": CONDITIONED, "adaptive": ADAPTIVE},
        made=f"{datetime.now(UTC):%d %B %Y, %H:%M} UTC",
        seed=seed,
        versions=f"Python {platform.python_version()}, NumPy {np.__version__}, Matplotlib {mpl.__version__}",
    )


def state(outcome: Outcome | None) -> State:
    """What is said of an outcome in a word."""
    match outcome:
        case None:
            return "missing"
        case Failed():
            return "failed"
        case Done(finding):
            match finding.holds:
                case Holds.YES:
                    return "yes"
                case Holds.NO:
                    return "no"
                case Holds.DIFFERS:
                    return "differs"


def shown(value: Value, unit: str = "") -> str:
    """A value for the table: three digits, powers of ten where they read better, with the unit; a text as it is."""
    if value is None:
        return "–"
    if isinstance(value, str):
        return value
    rounding = unit and abs(value) < _NOTHING
    return f"{_number(0.0 if rounding else value)} {unit}".rstrip().replace("-", "−")


def _number(value: float) -> str:
    if value == 0.0 or not np.isfinite(value):
        return f"{value:g}"
    if float(value).is_integer() and abs(value) < 1e6:
        return f"{value:.0f}"
    exponent = int(np.floor(np.log10(abs(value))))
    if not -4 <= exponent < 6:
        return f"{value / 10.0**exponent:.1f} · 10{str(exponent).translate(_SUPERSCRIPT)}"
    return f"{value:.{max(_DIGITS - 1 - exponent, 0)}f}"


def address(image: bytes) -> str:
    """An image as an address that carries it."""
    kind = "svg+xml" if is_svg(image) else "png"
    return f"data:image/{kind};base64,{base64.b64encode(image).decode()}"
