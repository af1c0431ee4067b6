"""`retouch study new`: a study of one's own, from a protocol that comes with Retouch."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from services.commands.arguments import add_debug
from services.commands.terminal import Terminal
from services.process.exit_codes import Exit
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
    say(f"{study.folder / 'protocol.toml'}: change it to yours, then", markup=False)
    say(f"  retouch study check {study.folder}", markup=False)
    say(
        f"  retouch study run {study.folder} --synthetic 4 --headless   # a rehearsal, elsewhere than the study",
        markup=False,
    )
    say(f"  retouch study freeze {study.folder}", markup=False)
    return Exit.DONE
