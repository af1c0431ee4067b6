"""`retouch study freeze`: from here on every change is a deviation."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from datetime import UTC, datetime
from pathlib import Path

from services.commands.arguments import add_debug
from services.commands.terminal import Terminal
from services.process.exit_codes import Exit
from services.study.preregistration import FILE
from services.study.readiness import ready
from services.study.study import open_study


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = (
        f"Writes down digests of protocol, questionnaires and analysis, and the versions of the software, and {FILE},"
        " a text for a registry and an ethics board. What changes later is refused until somebody says why;"
        " before anybody has begun the study it can be frozen anew."
    )
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="of the study")
    add_debug(parser)


def run(arguments: Namespace) -> int:
    """See `Action`."""
    study = open_study(arguments.folder)
    ready(study)
    before = study.frozen()
    frozen = study.freeze(datetime.now(UTC).isoformat(timespec="seconds"))
    say = Terminal(highlight=False, soft_wrap=True).print
    when = f"anew at {frozen.at}, before that at {before.at}" if before is not None else f"at {frozen.at}"
    say(f"frozen {when}; the preregistration is {study.folder / FILE}", markup=False)
    return Exit.DONE
