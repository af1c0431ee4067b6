"""`retouch study run`: participants go through a study."""

from __future__ import annotations

import os
from argparse import ArgumentParser, Namespace
from datetime import datetime
from pathlib import Path

from services.commands.arguments import add_debug, whole
from services.commands.progress import share_bar
from services.commands.terminal import Terminal
from services.process.exceptions import CommandFailed
from services.process.exit_codes import Exit
from services.study.instruments.library import of_protocol
from services.study.session.conductor import Conductor
from services.study.study import Study, open_study
from services.study.synthetic.run import StudyClock, SyntheticRun

_EXAMPLES = """\
examples:
  retouch study run my_study --synthetic 18 --headless       # a rehearsal of the whole study
  retouch study run my_study --synthetic 18 --headless       # again, after it was ended: goes on where it was
"""


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = (
        "Leads simulated participants through a study. Ended at any moment, by whatever, it goes on where it was when"
        " it is started again: nothing is lost, nothing is done twice."
    )
    parser.epilog = _EXAMPLES
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="of the study")
    parser.add_argument("--synthetic", type=whole(1), metavar="N", help="simulated participants, marked as such")
    parser.add_argument("--headless", action="store_true", help="without a page, as fast as it can")
    parser.add_argument("--seed", type=whole(0), default=0, metavar="N", help="of the simulated ones (default: 0)")
    parser.add_argument("--deviation", default="", metavar="REASON", help="why the study is no longer as it was frozen")
    parser.add_argument("--jobs", type=whole(1), metavar="N", help="processes (default: one a core)")
    add_debug(parser)


def run(arguments: Namespace) -> int:
    """See `Action`."""
    study = open_study(arguments.folder)
    if arguments.synthetic is None or not arguments.headless:
        raise CommandFailed("simulated participants only so far: say --synthetic N --headless")
    _rehearse(study, arguments)
    return Exit.DONE


def _rehearse(study: Study, arguments: Namespace) -> None:
    instruments = of_protocol(study.protocol, study.folder)
    written = study.entries()
    clock = StudyClock(datetime.fromisoformat(written[-1].at)) if written else StudyClock()
    console = Terminal(stderr=True, highlight=False)
    with (
        study.journal(clock, synthetic=True, deviation=arguments.deviation) as journal,
        share_bar(console, f"{arguments.synthetic} synthetic participants") as progress,
    ):
        conductor = Conductor(study.protocol, journal, instruments)
        going = SyntheticRun(study.protocol, instruments, conductor, clock, arguments.synthetic, arguments.seed)
        going.go(arguments.jobs or os.cpu_count() or 1, progress)
        done = sum(one.finished for one in conductor.participants().values())
    Terminal(highlight=False, soft_wrap=True).print(
        f"{done} of {arguments.synthetic} synthetic participants have finished; 'retouch study analyse {study.folder}'",
        markup=False,
    )
