"""`retouch task list`, `new`, `check` and `draw`."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from services.commands.arguments import add_debug
from services.commands.task.check import check, draw, listed
from services.commands.task.new import new

_ABOUT = """\
list              the tasks that ship
new FILE          a task file that runs, with a word on each of its lines
check NAME|FILE   what is missing in it, a line each; where nothing is, whether the robot
                  reaches its start and all of its region, which way it takes there, and
                  from where it would reach the region best, with a picture
draw NAME|FILE    the picture alone: both arrangements, the region, the way

  retouch task new mine.toml
  retouch task check mine.toml --robot-model arm.toml --out pictures
  retouch up --task mine.toml --robot-model arm.toml
"""


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = _ABOUT
    parser.add_argument("what", choices=("list", "new", "check", "draw"))
    parser.add_argument("which", nargs="?", metavar="NAME|FILE", default="", help="of a task")
    parser.add_argument("--robot-model", metavar="NAME|FILE", default="", help="that stands in it (default: tiago)")
    parser.add_argument("--out", type=Path, metavar="FOLDER", default=Path(), help="for pictures (default: this one)")
    add_debug(parser)


def run(arguments: Namespace) -> int:
    """See `Action`.

    Raises:
        CommandFailed: no task is named.
        ConfigurationError: the robot file cannot be read.
        SimError: there is no such task or robot, or it cannot be drawn.
        CannotWrite: a file cannot be written.
    """
    match arguments.what:
        case "list":
            return listed()
        case "new":
            return new(arguments.which)
        case "check":
            return check(arguments.which, arguments.robot_model, arguments.out)
        case _:
            return draw(arguments.which, arguments.robot_model, arguments.out)
