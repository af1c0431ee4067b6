"""`retouch up`: its flags."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from services.commands.arguments import add_backend, add_network, add_scene, add_skill
from services.commands.settings import configuration
from services.commands.sides import Side
from services.commands.up.launch import Launch, launch
from services.process.processes import PROCESS_NAMES

_ABOUT = """\
Starts the processes of a robot, or some of them, watches over them and stops them
cleanly on Ctrl-C. The robot stands until somebody presses a button on the page.
"""


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = _ABOUT
    add_network(parser)
    add_scene(parser)
    add_backend(parser)
    add_skill(parser)
    parser.add_argument("--headless", action="store_true", help="a scripted operator instead of the page")
    parser.add_argument("--once", action="store_true", help="end when the loop has closed, or the run is ended")
    parser.add_argument("--fresh", action="store_true", help="start from an empty model, kept in the run's folder")
    parser.add_argument(
        "--untaught",
        action="store_true",
        help="an empty model is shown its first motion by its operator",
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="write what happened")
    side = parser.add_mutually_exclusive_group()
    for one, whose in ((Side.SITE, "the robot's"), (Side.DESK, "the operator's")):
        about = f"{whose} side of a network, as the file's [{one.value}] says: {', '.join(one.processes)}"
        side.add_argument(f"--{one.value}", dest="side", action="store_const", const=one, help=about)
    parser.add_argument("--listen", metavar="ENDPOINT", help="where other machines may join (default: this one only)")
    parser.add_argument("--only", metavar="A,B", help=f"start only some of: {', '.join(PROCESS_NAMES)}")
    parser.add_argument("--no-browser", action="store_true", help="do not open the page")


def run(arguments: Namespace) -> int:
    """See `Action`."""
    settings = configuration(arguments)
    return launch(settings, Launch.from_arguments(arguments, settings))
