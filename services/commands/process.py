"""`retouch robot`, `retouch camera` and so on: one process alone, or a supervisor's child."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from services.commands.arguments import add_network, add_scene, add_skill
from services.commands.settings import configuration
from services.process.processes import process
from services.process.worker import run_process


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    add_network(parser)
    add_scene(parser)
    add_skill(parser)


def run(arguments: Namespace) -> int:
    """See `Action`."""
    run_process(process(arguments.command), configuration(arguments))
    return 0
