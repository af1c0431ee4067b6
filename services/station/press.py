"""What was pressed at the station: the one word for it between the page and the workflow."""

from __future__ import annotations

from dataclasses import dataclass

STOP = "stop"


@dataclass(frozen=True)
class Press:
    """One press of a button.

    Attributes:
        action: the button's name.
        argument: what it is about: a number, a name; empty where the button says it all.
    """

    action: str
    argument: str = ""
