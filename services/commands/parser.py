"""A parser that says what is wrong in one line, and knows a command's flags only where the command is meant."""

from __future__ import annotations

from argparse import SUPPRESS, Action, ArgumentError, ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, NoReturn

from services.process.exit_codes import Exit
from services.process.lines import one_line
from services.process.suggestion import nearest

_FLAG = "--"


class Parser(ArgumentParser):
    """See `ArgumentParser`; help keeps the lines that it was written in.

    Args:
        fill: adds the arguments, when something is to be parsed or told.

    Attributes:
        about_later: makes the last lines of the help, when it is asked for.
    """

    def __init__(self, *, fill: Callable[[ArgumentParser], None] | None = None, **settings: Any) -> None:
        super().__init__(formatter_class=partial(RawDescriptionHelpFormatter, max_help_position=28), **settings)
        self.about_later: Callable[[], str] | None = None
        self._fill = fill

    def parse_known_args(  # type: ignore[override]  # of the base's overloads the one that argparse itself calls
        self, args: Sequence[str] | None = None, namespace: Namespace | None = None
    ) -> tuple[Namespace, list[str]]:
        """As of any parser, its arguments added first; a command knows all of its own, and says so itself."""
        if self._fill is not None:
            fill, self._fill = self._fill, None
            fill(self)
        known, unknown = super().parse_known_args(args, namespace)
        if unknown:
            meant = self._meant(unknown)
            self.error(f"unrecognized arguments: {' '.join(unknown)}" + (f"; {meant}" if meant else ""))
        return known, unknown

    def _meant(self, unknown: Sequence[str]) -> str:
        """The flag that is nearest to the first that is unknown."""
        flag = next((word.partition("=")[0] for word in unknown if word.startswith(_FLAG)), "")
        told = [name for name, action in self._option_string_actions.items() if action.help != SUPPRESS]
        # That both are flags makes them no more alike.
        bare = [name.removeprefix(_FLAG) for name in told if name.startswith(_FLAG)]
        return nearest(flag.removeprefix(_FLAG), bare, _FLAG)

    def _check_value(self, action: Action, value: Any) -> None:
        """As of any parser; the nearest choice instead of all, where one is near."""
        choices = [str(choice) for choice in action.choices or ()]
        meant = nearest(str(value), choices)
        if meant and str(value) not in choices:
            raise ArgumentError(action, f"invalid choice: {value!r}; {meant}")
        super()._check_value(action, value)

    def format_help(self) -> str:
        """As of any parser, with the last lines."""
        if self.about_later is not None:
            self.epilog = self.about_later()
        return super().format_help()

    def error(self, message: str) -> NoReturn:
        """End with one line instead of the usage."""
        said = one_line(message)
        see = " See" if said.endswith("?") else "; see"
        self.exit(Exit.BAD_INPUT, f"{self.prog}: {said}{see} '{self.prog} --help'\n")
