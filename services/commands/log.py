"""`retouch log`: what a robot has written down about itself, for people, and whether it is as it was written."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace
from collections import deque
from pathlib import Path

from services.commands.arguments import add_debug, whole
from services.evidence import words
from services.evidence.ledger import path_of
from services.evidence.reading import Found, Reader, verify
from services.process.config import Configuration, load
from services.process.exit_codes import Exit
from services.process.lines import when

_ABOUT = """\
A robot writes down who held the authority, who commanded, stopped and corrected it,
which model's motion it executed and what came of it, under which settings and versions:
~/.local/state/retouch/ROBOT/evidence.jsonl, on the robot's machine, a line of JSON each.
Each line carries a digest of all lines before it. Whoever notes the newest digest
elsewhere can tell later that nothing up to there was changed or taken out.
"""

_EXAMPLES = """\
examples:
  retouch log show                    what happened, the oldest first
  retouch log show --last 20          the newest twenty entries
  retouch log verify                  is it as it was written? prints the newest digest
  retouch log verify --head 3f0c...   the same, and is what was noted there still in it?
  retouch log verify evidence.jsonl   of a file that was brought here

exit codes: 0 whole, 1 changed, 2 there is none
"""


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description, parser.epilog = _ABOUT, _EXAMPLES
    add_debug(parser)
    parts = parser.add_subparsers(dest="part", required=True, metavar="PART")
    show = parts.add_parser("show", help="what happened", description="What happened, the oldest first.")
    show.add_argument("--last", type=whole(1), metavar="N", help="only the newest N entries")
    check = parts.add_parser("verify", help="is it as it was written?", description="Is the log as it was written?")
    check.add_argument("--head", default="", metavar="DIGEST", help="that was noted earlier, and has to be in it")
    for part in (show, check):
        part.add_argument("file", nargs="?", type=Path, metavar="FILE", help="a log (default: the robot's own)")
        part.add_argument("--robot", metavar="NAME", help="whose log (default: robot1)")
        part.add_argument("--config", type=Path, metavar="FILE", help="a TOML file that names the robot")


def run(arguments: Namespace) -> int:
    """See `Action`."""
    path = arguments.file or path_of(_robot(arguments))
    return _show(path, arguments.last) if arguments.part == "show" else _verify(path, arguments.head.lower())


def _robot(arguments: Namespace) -> str:
    configured = load(arguments.config) if arguments.config else Configuration()
    name: str = arguments.robot or configured.name
    return name


def _show(path: Path, last: int | None) -> int:
    teller = words.Teller()
    told = ((found, teller.tell(found.entry)) for found in Reader(path))
    faults = 0
    for found, text in told if last is None else deque(told, last):
        faults += bool(found.fault)
        _say(_line(found, text))
        if found.fault:
            _say(f"        line {found.line}: {found.fault}")
    return Exit.CRASHED if faults else Exit.DONE


def _line(found: Found, text: str) -> str:
    if found.entry is None:
        return f"     ?  {text}"
    return f"{found.entry.number:>6}  {when(found.entry.at, seconds=True)}  {text}"


def _verify(path: Path, known: str) -> int:
    account = verify(path, known)
    for line, fault in account.faults:
        _say(f"{path}: line {line}: {fault}")
    if not account.known:
        _say(f"{path}: no entry has the digest {known}: what was written up to there is not what lies here")
    if account.unfinished:
        _say(f"{path}: {account.unfinished} bytes at its end are no entry; the robot tells of them at its next start")
    if account.whole:
        _say(f"{path}: {account.entries} entries, each as it was written; newest digest {account.head}")
    return Exit.DONE if account.whole else Exit.CRASHED


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
