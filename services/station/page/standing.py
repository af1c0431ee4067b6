"""How a tab stands at the desk: what it is told of itself and of who has the input."""

from __future__ import annotations

from dataclasses import dataclass

from protocol.messages import TakeOver
from services.station.page.identity import SOMEBODY, Identity


@dataclass(frozen=True)
class Standing:
    """How a tab stands.

    Attributes:
        armed: it has the seat: its input counts.
        vacant: nobody has the seat.
        let_go: it counts once everything that steers was let go.
        heard: what is held there comes, and in time.
        focused: it has the focus, as it said last.
        asked_s: somebody asks for this tab's seat, and gets it in so many seconds [s]; 0 where nobody does.
        asking_s: this tab asks for the seat and gets it in so many seconds [s]; 0 where it does not.
        kept: this tab asked for the seat, which was kept.
        stop_pressed: an emergency stop was pressed in some tab, and the robot has not confirmed it yet.
        accepted: numbers of this page's presses that were passed on.
        refused: numbers of those that were not.
        identity: who is there.
        asked_by: name of who asks for this tab's seat; empty where they gave none.
        lost: this tab had the seat, and somebody took it; None where that is not so.
    """

    armed: bool
    vacant: bool
    let_go: bool
    heard: bool
    focused: bool
    asked_s: float
    asking_s: float
    kept: bool
    stop_pressed: bool
    accepted: tuple[int, ...]
    refused: tuple[int, ...]
    identity: Identity = SOMEBODY
    asked_by: str = ""
    lost: TakeOver | None = None
