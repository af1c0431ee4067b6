"""`retouch topics`: the registry as the README has it."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace

from protocol.table import query_table, topic_table
from services.commands.arguments import add_debug


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    add_debug(parser)


def run(arguments: Namespace) -> int:
    """See `Action`."""
    del arguments
    sys.stdout.write(f"{topic_table()}\n\n{query_table()}\n")
    return 0
