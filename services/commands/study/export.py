"""`retouch study export`: the data for others, without a name."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from services.commands.arguments import add_debug
from services.commands.terminal import Terminal
from services.process.exit_codes import Exit
from services.study.export import export
from services.study.instruments.library import of_protocol
from services.study.study import open_study


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = (
        "Writes a Psych-DS data set: tidy tables with every attempt and answer, a codebook, protocol and"
        " questionnaires. Participants are codes; who they are, and what the experimenter noted, is not in it."
    )
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="of the study")
    parser.add_argument("out", type=Path, metavar="OUT", help="folder of the data set; a new one")
    add_debug(parser)


def run(arguments: Namespace) -> int:
    """See `Action`."""
    study = open_study(arguments.folder)
    instruments = of_protocol(study.protocol, study.folder)
    tables = export(study, study.entries(), instruments, arguments.out)
    say = Terminal(highlight=False, soft_wrap=True).print
    for table in tables:
        say(str(table), markup=False)
    return Exit.DONE
