"""`retouch robot`: one process alone; with a word after it, what there is to know of robots."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from services.commands import process
from services.commands.arguments import add_backend
from services.commands.robot.check import check, draw, listed
from services.commands.settings import configuration

_ABOUT = """\
Without a word: the process that owns the arm. With one:

list              the robots that ship
check NAME|FILE   what is missing in a robot file, a line each; where nothing is, how far
                  the robot reaches, and two pictures: the home posture with its frames,
                  and where it can grasp
draw NAME|FILE    the picture of the home posture alone

  retouch robot check my-arm.toml --out pictures
  retouch up --robot-model my-arm.toml
"""

_WORDS = ("list", "check", "draw")


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = _ABOUT
    parser.add_argument("what", nargs="?", choices=_WORDS)
    parser.add_argument("which", nargs="?", metavar="NAME|FILE", help="of a robot (default: as configured)")
    process.add_arguments(parser)
    add_backend(parser)
    parser.add_argument("--out", type=Path, metavar="FOLDER", default=Path(), help="for pictures (default: this one)")


def run(arguments: Namespace) -> int:
    """See `Action`.

    Raises:
        ConfigurationError: the robot file cannot be read.
        SimError: there is no such robot, or it cannot be drawn.
        CannotWrite: a picture cannot be written.
    """
    match arguments.what:
        case None:
            return process.run(arguments)
        case "list":
            return listed()
        case "check":
            return check(_which(arguments), arguments.out)
        case _:
            return draw(_which(arguments), arguments.out)


def _which(arguments: Namespace) -> str:
    return arguments.which or configuration(arguments).robot.model
