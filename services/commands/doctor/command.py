"""`retouch doctor`: what is wrong between two machines, in one line each, and what to do."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace

from services.commands.arguments import add_network
from services.commands.doctor.case import Case
from services.commands.doctor.examination import examine
from services.commands.doctor.finding import Verdict
from services.commands.settings import configuration as configured
from services.process.clock import SystemClock
from services.process.config import Configuration, load
from services.process.ending import end_within
from services.process.exit_codes import Exit
from services.process.runner import stop_on_signals

_ABOUT = """\
Finds out what is wrong between this machine and a robot's, and what to do: a line for
each thing, as it is found.

  ok             as it should be
  look at this   it works, and you should know
  wrong          it does not work; what to do stands behind it
  not made       an earlier check failed that this one needs

What is looked at, in this order:

  computer       is it too busy to be in time? Said only where it is
  name           the host's name leads to an address
  port           somebody listens there, and how far away; or the machine refuses, nothing
                 answers (off, a firewall), no way leads there
  certificate    this machine has one, in its time; a TLS handshake, as processes make it
  router         a session opens
  entry          the router passes on what this machine says: a revoked certificate is
                 let in, and nothing of it is
  processes      which robots are there, with which processes; is yours among them?
  version        everybody speaks this version of the protocol
  clock          how evenly the robot's samples come; times of day that are far apart
  way            there and back, as control travels: time, jitter, loss, silence
  pictures       how much comes through as pictures travel, and is it enough for two cameras?
  rights         what this certificate may do; a question to the model that changes nothing

Nothing here moves a robot or disturbs one that runs: no more than 4 MB are sent, within
two seconds, behind everything else. It takes about ten seconds.
"""

_EXAMPLES = """\
examples:
  retouch doctor                              this machine's own network
  retouch doctor tls/192.0.2.1:7447 --robot kitchen
                                              at the operator, of the robot's site
  retouch doctor --config network.toml        the way from a desk to the site of that file

exit codes: 0 nothing is wrong, 1 something is, 2 wrong input, 130 interrupted
"""


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description, parser.epilog = _ABOUT, _EXAMPLES
    parser.add_argument(
        "endpoint",
        nargs="?",
        metavar="ENDPOINT",
        help="of the router (default: as the file says, its 'connect' or that of its [desk])",
    )
    add_network(parser)


def run(arguments: Namespace) -> int:
    """See `Action`."""
    arguments.connect = endpoint(arguments)
    case = Case(configured(arguments), SystemClock(), stop_on_signals())
    end_within()
    with case.open:
        return _told(case)


def endpoint(arguments: Namespace) -> str | None:
    """Where the other side is, as the command or a file of both sides says; None for the configuration's `connect`.

    Raises:
        ConfigurationError: the file cannot be used.
    """
    given: str | None = arguments.endpoint or arguments.connect
    if given or arguments.config is None:
        return given
    file = load(arguments.config)
    return file.desk.connect if file.desk.connect and file.connect == Configuration().connect else None


def _told(case: Case) -> int:
    """Print what is found, as it is found; the exit code."""
    well = True
    for finding in examine(case):
        well = well and finding.verdict is not Verdict.WRONG
        sys.stdout.write(f"{finding.line}\n")
        sys.stdout.flush()
    return Exit.DONE if well else Exit.CRASHED
