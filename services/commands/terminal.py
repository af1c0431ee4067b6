"""Where commands print for people."""

from __future__ import annotations

from rich.console import Console


class Terminal(Console):
    """A console that goes quiet where nobody reads any more; Rich's own would end the program."""

    def on_broken_pipe(self) -> None:
        """Print nothing from now on."""
        self.quiet = True
