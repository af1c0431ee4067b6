"""`retouch study new`: a study of one's own, from a protocol that comes with Retouch."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from services.commands.arguments import add_debug
from services.commands.terminal import Terminal
from services.process.exit_codes import Exit
from services.study.instruments.library import FOLDER
from services.study.protocol.protocol import FILE
from services.study.protocols import SHIPPED
from services.study.study import new_study


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = "Makes a folder with a protocol that you change to yours."
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="of the study; a new one")
    parser.add_argument("--like", choices=sorted(SHIPPED), default="thesis", help="protocol to begin with")
    add_debug(parser)


def run(arguments: Namespace) -> int:
    """See `Action`."""
    study = new_study(arguments.folder, SHIPPED[arguments.like])
    say = Terminal(highlight=False, soft_wrap=True).print
    home = study.folder.resolve()
    rehearsal = home.with_name(f"{home.name}_rehearsal")
    for line in (
        f"{study.folder / FILE}: change it to yours",
        f"{study.folder / FOLDER / 'NAME.toml'}: questionnaires of your own, like deploy/examples/questionnaire.toml",
        "then",
        f"  retouch study check {study.folder}",
        # In the study's own folder simulated participants would keep people out.
        f"  cp -r {home} {rehearsal}   # a rehearsal has a folder of its own",
        f"  retouch study run {rehearsal} --synthetic 4 --headless",
        f"  retouch study freeze {study.folder}",
    ):
        say(line, markup=False)
    return Exit.DONE
