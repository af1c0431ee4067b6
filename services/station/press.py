"""What was pressed at the station: the one word for it between the page and the workflow."""

from __future__ import annotations

from dataclasses import dataclass

STOP, STOP_OTHER, REVOKE = "stop", "stop_other", "revoke"
"""What is pressed by others than who has the input: the robot's stop, another robot's, the end of the authority."""

STOPS = frozenset((STOP, STOP_OTHER))
"""Whoever presses one, however late it comes: it counts."""


@dataclass(frozen=True)
class Press:
    """One press of a button.

    Attributes:
        action: the button's name.
        argument: what it is about: a number, a name, a reason; empty where the button says it all.
        by: who pressed it; empty where they gave no name.
    """

    action: str
    argument: str = ""
    by: str = ""
