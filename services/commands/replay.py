"""`retouch replay FILE`: a recording in Rerun's own window."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from services.commands.arguments import add_debug
from services.viewer.replay import replay


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.add_argument("file", type=Path, metavar="FILE", help="a recording (.rrd)")
    add_debug(parser)


def run(arguments: Namespace) -> int:
    """See `Action`."""
    replay(arguments.file)
    return 0
