"""What an operator has before them, whoever they are: the page of a person, or what stands in for one."""

from __future__ import annotations

import threading
from typing import Protocol

from protocol.messages import Attendance, Figure, OperatorInput
from services.station.history import Wanted
from services.station.page.view import PageView
from services.station.press import Press


class Frontend(Protocol):
    """What shows the station, and takes what is held and pressed."""

    @property
    def effects(self) -> Wanted:
        """What entries of the history change, as far as it is to be shown."""
        ...

    @property
    def call(self) -> threading.Event:
        """Set where something was pressed or let go."""
        ...

    @property
    def jpeg_only(self) -> bool:
        """Somebody looks whose browser draws pictures of no other coding."""
        ...

    def show(self, view: PageView) -> None:
        """Show this from now on."""
        ...

    def take_input(self) -> OperatorInput:
        """The FULL input state."""
        ...

    def take_presses(self) -> list[Press]:
        """The buttons pressed since the last call."""
        ...

    def attendance(self) -> Attendance:
        """Who is there."""
        ...

    def figures(self) -> tuple[Figure, ...]:
        """What it measured."""
        ...

    def close(self) -> None:
        """Show nothing any more."""
        ...
