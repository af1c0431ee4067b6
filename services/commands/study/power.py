"""`retouch study power`: how many people a study needs for an effect of what size."""

from __future__ import annotations

import csv
import io
import os
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Mapping
from pathlib import Path

from services.commands.arguments import add_debug, whole
from services.commands.progress import share_bar
from services.commands.study import grouped
from services.commands.terminal import Terminal
from services.offline.proportion import Proportion
from services.process.exit_codes import Exit
from services.process.files import write_file
from services.study.study import open_study
from services.study.synthetic.population import Population
from services.study.synthetic.power import Cell, Question, power

_ABOUT = """\
Draws studies of synthetic people, analyses each by the study's own rules, and says
how many of them show each confirmatory hypothesis where it alone holds: the power,
and with an effect of 0 the error rate. An effect of 0.2: the first side of the
hypothesis takes a fifth less time, or work, than the second.

The spread between people and models is assumed, see the flags; take a pilot's.
"""

_EXAMPLES = """\
examples:
  retouch study power my_study
  retouch study power my_study --people 12,18,24 --effects 0,0.1,0.2 --studies 2000
"""


_LOOSE = 0.1
"""Width of an interval from which on a share is not told without it."""


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description, parser.epilog = _ABOUT, _EXAMPLES
    usual = Population()
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="of the study")
    parser.add_argument("--people", type=_counts, default=(8, 12, 18, 24, 36), metavar="N,...", help="to try")
    parser.add_argument("--effects", type=_shares, default=(0.0, 0.1, 0.2, 0.3), metavar="E,...", help="to try")
    parser.add_argument("--studies", type=whole(1), default=500, metavar="N", help="of each (default: 500)")
    parser.add_argument("--seed", type=whole(0), default=0, metavar="N", help="of all of them (default: 0)")
    for name, value, about in (
        ("seconds", usual.seconds, "median refinement time [s]"),
        ("people-spread", usual.people, "of the logarithm of times between people"),
        ("models-spread", usual.models, "the same between the models of one person"),
    ):
        parser.add_argument(f"--{name}", type=float, default=value, metavar="X", help=f"{about} (default: {value:g})")
    parser.add_argument("--csv", type=Path, metavar="FILE", help="write the figures, with their intervals")
    parser.add_argument("--jobs", type=whole(1), metavar="N", help="processes (default: one a core)")
    parser.add_argument(
        "--cluster",
        default="",
        metavar="ADDRESS",
        help="of a Dask scheduler, such as tcp://10.0.0.1:8786, whose machines do the work instead of this one",
    )
    add_debug(parser)


def run(arguments: Namespace) -> int:
    """See `Action`."""
    study = open_study(arguments.folder)
    population = Population(seconds=arguments.seconds, people=arguments.people_spread, models=arguments.models_spread)
    question = Question(
        study.protocol, arguments.people, arguments.effects, arguments.studies, arguments.seed, population
    )
    with share_bar(Terminal(stderr=True, highlight=False), "synthetic studies") as progress:
        found = power(question, arguments.jobs or os.cpu_count() or 1, progress, arguments.cluster)
    _show(found, question)
    if arguments.csv is not None:
        write_file(arguments.csv, _csv(found).encode())
    return Exit.DONE


def _show(found: Mapping[Cell, Proportion], question: Question) -> None:
    loose = any(one.interval[1] - one.interval[0] > _LOOSE for one in found.values())
    groups = {
        name: [
            [str(people), *(_told(found[Cell(people, effect, name)], loose=loose) for effect in question.effects)]
            for people in question.people
        ]
        for name in dict.fromkeys(cell.hypothesis for cell in found)
    }
    console = Terminal(highlight=False)
    grouped.show(console, ["people", *(f"effect {effect:g}" for effect in question.effects)], groups)
    drawn = f"Of {question.studies} synthetic studies each{', with 95 % intervals' if loose else ''}"
    console.print(f"{drawn}; no person took part.", markup=False)


def _told(one: Proportion, *, loose: bool) -> str:
    low, high = (100.0 * end for end in one.interval)
    return f"{one.successes / one.trials:.0%}{f' ({low:.0f}-{high:.0f})' if loose else ''}"


def _csv(found: Mapping[Cell, Proportion]) -> str:
    text = io.StringIO()
    out = csv.writer(text, lineterminator="\n")
    out.writerow(("hypothesis", "people", "effect", "studies", "shown", "share", "low", "high", "synthetic"))
    for cell, one in found.items():
        share = one.successes / one.trials
        out.writerow((cell.hypothesis, cell.people, cell.effect, one.trials, one.successes, share, *one.interval, True))
    return text.getvalue()


def _counts(text: str) -> tuple[int, ...]:
    try:
        found = tuple(int(part) for part in text.split(","))
    except ValueError:
        found = ()
    if not found or min(found) < 2:
        raise ArgumentTypeError(f"numbers of people, such as 12,18,24, not {text!r}")
    return found


def _shares(text: str) -> tuple[float, ...]:
    try:
        found = tuple(float(part) for part in text.split(","))
    except ValueError:
        found = ()
    if not found or not all(0.0 <= share < 1.0 for share in found):
        raise ArgumentTypeError(f"shares from 0 to 1, such as 0,0.1,0.2, not {text!r}")
    return found
