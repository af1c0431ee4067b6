"""`retouch study analyse`: statistics and the report of a study, from anybody's table."""

from __future__ import annotations

from argparse import ArgumentParser, ArgumentTypeError, Namespace
from pathlib import Path

import msgspec
from rich.console import Console
from rich.text import Text

from services.commands.arguments import add_debug, whole
from services.commands.progress import share_bar
from services.commands.study import grouped
from services.commands.terminal import Terminal
from services.process.exit_codes import Exit
from services.process.written import read
from services.study.analysis.analysis import Analysis
from services.study.analysis.exceptions import NothingToAnalyse
from services.study.analysis.exclusion import Sample
from services.study.analysis.hypotheses import Plan
from services.study.analysis.numerals import figure, interval, p_value
from services.study.analysis.observations import Observations
from services.study.analysis.report import REPORT, report
from services.study.analysis.reporting import Reporting
from services.study.analysis.rules import NAMES, RETOUCH
from services.study.analysis.table import NEEDED, OPTIONAL, read_observations
from services.study.instruments.library import of_protocol
from services.study.records import observed
from services.study.study import open_study
from services.study.told import reporting_of, source_of

_ABOUT = f"""\
Analyses a study, or anybody's table, and writes a folder: {REPORT}, which needs nothing else, all its
numbers as JSON, and tidy tables.

FILE is a CSV of any spreadsheet with a line a participant, method and model.
Its first line names the columns {", ".join(NEEDED)} [s];
others are read where they are there:
  {", ".join(OPTIONAL[:10])},
  {", ".join(OPTIONAL[10:17])},
  {", ".join(OPTIONAL[17:])}.
An empty cell was not measured. What holds for a participant, or for a participant
and a method (workload, position), stands in one of the lines or in each of them.

Rules: retouch has the participant as the unit, thesis counts each model of each
participant, as the thesis' Tables II and E.2 do, and says what is wrong with it.
"""

_EXAMPLES = """\
examples:
  retouch study analyse my_study                      # by its protocol's rules and hypotheses
  retouch study analyse outcomes.csv
  retouch study analyse data.csv --columns participant=subject,seconds=time --methods OnStyl=online_pen
  retouch study analyse data.csv --plan plan.toml     # hypotheses of your own
"""


_EFFECT = ("p, Holm", "rank-biserial", "shift (interval)")

_VERDICTS = {
    None: Text("exploratory"),
    True: Text("supported", style="green"),
    False: Text("not shown", style="yellow"),
}


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description, parser.epilog = _ABOUT, _EXAMPLES
    parser.add_argument("source", type=Path, metavar="STUDY|FILE", help="a study's folder, or a CSV of outcomes")
    parser.add_argument(
        "--out", type=Path, metavar="FOLDER", help="of the report (default: STUDY/derived, or ./analysis)"
    )
    parser.add_argument("--rules", choices=NAMES, help="of the analysis (default: the plan's, or retouch)")
    parser.add_argument("--plan", type=Path, metavar="FILE", help="hypotheses, rules, error rate: a TOML file")
    parser.add_argument("--reporting", type=Path, metavar="FILE", help="what the appendix needs: a TOML file")
    parser.add_argument(
        "--columns", type=renamed, default={}, metavar="OURS=THEIRS,...", help="what the file calls the columns"
    )
    parser.add_argument(
        "--methods", type=renamed, default={}, metavar="OURS=THEIRS,...", help="what the file calls the methods"
    )
    parser.add_argument("--seed", type=whole(0), metavar="N", help="of resampling (default: the plan's, or 0)")
    add_debug(parser)


def run(arguments: Namespace) -> int:
    """See `Action`."""
    source = arguments.source
    observations, plan, reporting = _of_study(source) if source.is_dir() else _of_table(arguments)
    if arguments.plan:
        plan = read(arguments.plan, Plan, "plan")
    given = {name: getattr(arguments, name) for name in ("rules", "seed") if getattr(arguments, name) is not None}
    plan = msgspec.structs.replace(plan, **given)
    if arguments.reporting:
        reporting = read(arguments.reporting, Reporting, "reporting file")
    out = arguments.out or (source / "derived" if source.is_dir() else Path("analysis"))
    console = Terminal(stderr=True, highlight=False)
    for note in observations.notes:
        console.print(note, markup=False, soft_wrap=True)
    with share_bar(console, "analysing") as progress:
        analysis = report(out, observations, plan, reporting, progress)
    summarise(analysis, console)
    Terminal(highlight=False, soft_wrap=True).print(str((out / REPORT).resolve()), markup=False)
    return Exit.DONE


def _of_study(folder: Path) -> tuple[Observations, Plan, Reporting]:
    """Of a study's own folder: what its journal says, and what its protocol has fixed.

    Raises:
        NothingToAnalyse: nobody has taken part yet.
    """
    study = open_study(folder)
    instruments, entries = of_protocol(study.protocol, folder), study.entries()
    if not entries:
        raise NothingToAnalyse(f"nobody has taken part in {folder} yet")
    observations = observed(study.protocol, entries, instruments, source_of(study))
    return observations, study.protocol.plan, reporting_of(study, entries, instruments)


def _of_table(arguments: Namespace) -> tuple[Observations, Plan, Reporting]:
    return read_observations(arguments.source, arguments.columns, arguments.methods), Plan(), Reporting()


def summarise(analysis: Analysis, console: Console) -> None:
    """Say what came out: who took part, and what became of the hypotheses."""
    flow = analysis.flow
    who = "synthetic participants: no person took part" if analysis.synthetic else "participants"
    console.print(
        f"{flow.participants} {who}; {flow.included} in the refinement time, {len(flow.excluded)} excluded;"
        f" rules: {analysis.plan.rules}",
        soft_wrap=True,
    )
    ours = analysis.plan.rules == RETOUCH.name
    groups: dict[str, list[list[str | Text]]] = {}
    for one in analysis.results:
        if one.sample is Sample.PLANNED and one.test is not None:
            shift = f"{figure(one.shift.value)}{f' ({bounds})' if (bounds := interval(one.shift)) else ''}"
            effect = [p_value(one.adjusted), figure(one.effect.value, 2), shift] if ours else []
            groups[one.hypothesis.name] = [[_VERDICTS[one.rejected], str(one.pairs), p_value(one.test.p), *effect]]
    grouped.show(console, ["", "pairs", "p", *(_EFFECT if ours else ())], groups)


def renamed(text: str) -> dict[str, str]:
    """The type of OURS=THEIRS,..."""
    pairs = [part.partition("=") for part in text.split(",")]
    names = {ours.strip(): theirs.strip() for ours, _, theirs in pairs}
    if not all(names) or not all(names.values()) or len(names) < len(pairs):
        raise ArgumentTypeError(f"must be OURS=THEIRS,..., each of OURS once, not {text!r}")
    return names
