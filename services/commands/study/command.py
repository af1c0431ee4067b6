"""`retouch study`: the human-factors study, each part in a module of its own."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from services.commands.command import Command
from services.commands.parser import Parser

PARTS: tuple[Command, ...] = (
    Command("new", "services.commands.study.new", "make one, from a protocol that you change", needs="study"),
    Command("check", "services.commands.study.check", "does it agree with itself, how far is it", needs="study"),
    Command("freeze", "services.commands.study.freeze", "from here on every change has a reason", needs="study"),
    Command("run", "services.commands.study.run", "participants go through it, people or simulated", needs="study"),
    Command("export", "services.commands.study.export", "the data for others, without a name", needs="study"),
    Command("power", "services.commands.study.power", "how many people for an effect of what size", needs="study"),
    Command("analyse", "services.commands.study.analyse", "statistics and the report of a study", needs="study"),
)

_ABOUT = """\
A study of people who use several methods, from its protocol to its report.
`retouch study PART --help` tells of each part.
"""


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = _ABOUT
    parts = parser.add_subparsers(dest="part", required=True, metavar="PART", parser_class=Parser)
    for part in PARTS:
        parts.add_parser(part.name, help=part.help, fill=lambda p, part=part: part.action().add_arguments(p))


def run(arguments: Namespace) -> int:
    """See `Action`."""
    return next(part for part in PARTS if part.name == arguments.part).action().run(arguments)
