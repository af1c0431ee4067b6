"""What a command is; each is named in `services.commands.table` and lives in a module of its own."""

from __future__ import annotations

import importlib
from argparse import ArgumentParser, Namespace
from dataclasses import dataclass
from typing import Protocol, cast

from services.process.exceptions import RoomMissing


class Action(Protocol):
    """What a command's module has: its flags, and what it does."""

    def add_arguments(self, parser: ArgumentParser) -> None:
        """Give the parser the command's flags, and its help what the table has no room for."""
        ...

    def run(self, arguments: Namespace) -> int:
        """Do it; the exit code.

        Raises:
            ServiceError: in one line for the person who asked, as any other room's error.
        """
        ...


@dataclass(frozen=True)
class Command:
    """One command of `retouch`.

    Attributes:
        name: as it is typed.
        module: which has what `Action` says; loaded only where the command is meant, for most rooms take long.
        help: one line for `retouch --help`.
        needs: the extra of the package that holds what the module imports; empty where it is called as the command.
    """

    name: str
    module: str
    help: str
    needs: str = ""

    def action(self) -> Action:
        """The command's module.

        Raises:
            RoomMissing: a package that it imports is not installed.
        """
        try:
            return cast(Action, importlib.import_module(self.module))
        except ModuleNotFoundError as error:
            raise RoomMissing(self.needs or self.name, error.name or "?") from None
