"""`retouch study run`: participants go through a study."""

from __future__ import annotations

import os
from argparse import ArgumentParser, Namespace
from datetime import datetime
from pathlib import Path

from services.commands.arguments import add_debug, whole
from services.commands.opening import open_in_browser
from services.commands.progress import share_bar
from services.commands.terminal import Terminal
from services.process.exceptions import CommandFailed
from services.process.exit_codes import Exit
from services.process.ports import check_port
from services.process.runner import stop_on_signals
from services.study.journal import check_closed
from services.study.readiness import ready
from services.study.session.conductor import Conductor
from services.study.session.markers import lab_streaming, stream
from services.study.study import Study, open_study
from services.study.synthetic.rehearsal import Rehearsal
from services.study.synthetic.run import StudyClock, SyntheticRun

_PORT = 8090

_EXAMPLES = """\
examples:
  retouch study run my_study                                 # people: console and participant's page in browsers
  retouch study run rehearsal --synthetic 1                  # the same pages, played through by you, marked as such
  retouch study run rehearsal --synthetic 18 --headless      # a rehearsal of the whole study, in the simulator
"""


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = (
        "Leads participants through a study. Ended at any moment, by whatever, it goes on where it was when it is"
        " started again: nothing is lost, nothing is done twice. The robot is simulated."
    )
    parser.epilog = _EXAMPLES
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="of the study")
    parser.add_argument(
        "--port",
        type=whole(1),
        default=_PORT,
        metavar="N",
        help=f"of the pages; the robot's has the next one (default: {_PORT})",
    )
    parser.add_argument("--no-browser", action="store_true", help="do not open the console")
    parser.add_argument(
        "--synthetic",
        type=whole(1),
        metavar="N",
        help="no people: simulated participants; with the pages, whoever rehearses plays them. Marked as such",
    )
    parser.add_argument("--headless", action="store_true", help="simulated ones without a page, as fast as it can")
    parser.add_argument("--seed", type=whole(0), default=0, metavar="N", help="of the simulated ones (default: 0)")
    parser.add_argument("--deviation", default="", metavar="REASON", help="why the study is no longer as it was frozen")
    parser.add_argument("--jobs", type=whole(1), metavar="N", help="processes (default: one a core)")
    add_debug(parser)


def run(arguments: Namespace) -> int:
    """See `Action`."""
    study = open_study(arguments.folder)
    rehearsal = None if arguments.synthetic is None else Rehearsal(arguments.synthetic, arguments.seed)
    if not arguments.headless:
        _with_pages(study, arguments, rehearsal)
    elif rehearsal is None:
        raise CommandFailed("--headless: people need the pages; leave it out, or say --synthetic N")
    else:
        _rehearse(study, arguments, rehearsal)
    return Exit.DONE


def _with_pages(study: Study, arguments: Namespace, rehearsal: Rehearsal | None) -> None:
    """Serve console and participant's page until somebody ends it."""
    # Imported here: who simulates everything needs neither a web server nor the network.
    from services.study.live.serving import ADDRESS, LAST_PORT, served  # noqa: PLC0415

    port = arguments.port
    if port > LAST_PORT:
        raise CommandFailed(f"--port: must be at most {LAST_PORT}, not {port}: the robot's page has the next one")
    check_closed(study.raw)  # before the ports, which who has it open listens at
    check_port("the study's page", ADDRESS, port, "--port")
    check_port("the robot's page", ADDRESS, port + 1, "--port")
    say = Terminal(highlight=False, soft_wrap=True).print
    say("getting ready", markup=False)
    marked = lab_streaming(study.protocol.name)
    with served(study, port, arguments.deviation, rehearsal, marked) as page:
        stop = stop_on_signals()
        if marked is not None:
            say(f"markers for other recorders go out as {stream(study.protocol.name)}", markup=False)
        if rehearsal is not None:
            say("a rehearsal: whoever is enrolled is marked as simulated", markup=False)
        say(f"the experimenter's console is {page.console_url}", markup=False)
        say(f"participants go to            {page.url}", markup=False)
        if not arguments.no_browser:
            open_in_browser(page.console_url)
        stop.wait()
        say("stopping", markup=False)


def _rehearse(study: Study, arguments: Namespace, rehearsal: Rehearsal) -> None:
    instruments = ready(study).instruments
    written = study.entries()
    clock = StudyClock(datetime.fromisoformat(written[-1].at)) if written else StudyClock()
    console = Terminal(stderr=True, highlight=False)
    with (
        study.journal(clock, synthetic=True, deviation=arguments.deviation) as journal,
        share_bar(console, f"{rehearsal.people} synthetic participants") as progress,
    ):
        conductor = Conductor(study.protocol, journal, instruments)
        going = SyntheticRun(study.protocol, instruments, conductor, clock, rehearsal)
        going.go(arguments.jobs or os.cpu_count() or 1, progress)
        done = sum(one.finished for one in conductor.participants().values())
    Terminal(highlight=False, soft_wrap=True).print(
        f"{done} of {rehearsal.people} synthetic participants have finished; 'retouch study analyse {study.folder}'",
        markup=False,
    )
