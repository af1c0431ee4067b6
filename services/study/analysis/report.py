"""The report: one HTML file that needs nothing else, with all that a paper needs."""

from __future__ import annotations

from datetime import UTC, datetime
from functools import cache, partial
from pathlib import Path

import jinja2

from services.process.files import write_file
from services.reproduction.analysis import Figure
from services.reproduction.report import address
from services.study.analysis import effect_figures, figures
from services.study.analysis.analysis import Analysis, Progress, analysed
from services.study.analysis.comparison import Result
from services.study.analysis.exclusion import Sample
from services.study.analysis.files import write_files
from services.study.analysis.hypotheses import Measure, Plan
from services.study.analysis.methods import paragraph, software
from services.study.analysis.numerals import equals, exactly, figure, interval, p_value
from services.study.analysis.observations import Observations
from services.study.analysis.reporting import Reporting, appendix
from services.study.analysis.rules import THESIS

REPORT = "report.html"

_ANALYSED = 0.5  # of the work; the rest is drawing


def report(
    folder: Path,
    observations: Observations,
    plan: Plan,
    reporting: Reporting | None = None,
    progress: Progress = lambda _: None,
) -> Analysis:
    """Analyse a study, and write the report and the tables.

    Args:
        folder: of the files; made where it is missing.
        observations: of the study.
        plan: that was fixed before it.
        reporting: what only its protocol knows.
        progress: is told how it goes on.

    Returns:
        The figures, which `folder` has as `REPORT`, as tables and as JSON.

    Raises:
        AnalysisError: the observations or the plan cannot be used.
        CannotWrite: a file cannot be written.
    """
    observations = observations.arranged(plan.methods)
    analysis = analysed(observations, plan, lambda share: progress(_ANALYSED * share))
    write_files(folder, observations, analysis)
    text = html(observations, analysis, reporting or Reporting(), lambda share: progress(_ANALYSED * (1.0 + share)))
    write_file(folder / REPORT, text.encode())
    progress(1.0)
    return analysis


def html(
    observations: Observations, analysis: Analysis, reporting: Reporting, progress: Progress = lambda _: None
) -> str:
    """The report as text, see `report`."""
    drawn = {}
    makers = (figures.by_method, figures.other_ratings, figures.by_model, figures.adaptation, figures.learning)
    for i, make in enumerate(makers):
        drawn[make.__name__] = make(observations, analysis) if _can(make.__name__, observations) else None
        progress((i + 1) / (len(makers) + 2))
    drawn["effects"] = effect_figures.effects(analysis)
    return _template().render(
        analysis=analysis,
        observations=observations,
        reporting=reporting,
        items=appendix(observations, analysis, reporting),
        paragraph=paragraph(analysis),
        figures=drawn,
        background_figures=effect_figures.backgrounds(observations, analysis),
        decided=[one for one in analysis.results if one.sample is Sample.PLANNED and one.hypothesis.confirmatory],
        measures=list(dict.fromkeys(one.measure for one in analysis.summaries)),
        samples=list(dict.fromkeys(one.sample for one in analysis.results)),
        thesis=analysis.plan.rules == THESIS.name,
        contrasts=list(dict.fromkeys(_stated(one) for one in analysis.results)),
        results_of=partial(_result, analysis),
        colors={method: figures.color_of(analysis, method) for method in analysis.methods},
        Measure=Measure,
        Sample=Sample,
        made=f"{datetime.now(UTC):%d %B %Y, %H:%M} UTC",
        software=software(),
    )


def _stated(result: Result) -> str:
    first, second = result.hypothesis.sides
    return f"{first} {result.hypothesis.direction.sign} {second}"


def _result(analysis: Analysis, measure: Measure, sample: Sample, stated: str) -> Result | None:
    """Of the hypothesis that says so of the measure."""
    of = [one for one in analysis.results if one.hypothesis.measure is measure and one.sample is sample]
    return next((one for one in of if _stated(one) == stated), None)


def _can(name: str, observations: Observations) -> bool:
    """A figure has something to show."""
    timed = any(one.seconds is not None and one.adapted for one in observations.outcomes)
    return timed or name not in ("by_model", "learning")


@cache
def _template() -> jinja2.Template:
    here = Path(__file__).parent
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader([here, here.parents[1] / "reproduction"]),  # the style sheet is that report's
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {
        "figure": figure,
        "p_value": p_value,
        "equals": equals,
        "exactly": exactly,
        "interval": interval,
        "address": lambda one: address(one.image) if isinstance(one, Figure) else "",
    }
    return environment.get_template("report.html.jinja")
