"""Who sits at the device: the newest input at its station, and whether the robot lets that station command."""

from __future__ import annotations

import threading
from dataclasses import dataclass

from protocol.messages import AuthorityState, OperatorInput
from protocol.topics import AUTHORITY_STATE, OPERATOR_INPUT
from services.bus.bus import Bus
from services.bus.senders import Senders


@dataclass(frozen=True)
class Sitting:
    """What the operator does at one moment.

    Attributes:
        operator: the newest input of the operator that counts; None where none is fresh.
        commands: the robot says that this input's station holds the authority, under the epoch that stands in it.
    """

    operator: OperatorInput | None
    commands: bool

    @property
    def keys(self) -> tuple[str, ...]:
        """Held down."""
        return self.operator.keys if self.operator is not None else ()


class Seat:
    """Follows the inputs at one station, whoever sits there, whatever other stations say.

    Where it is renewed, both are heard for a moment: the one that holds the authority goes before the other.

    Attributes:
        call: set where an input came.

    Args:
        bus: to hear stations and robot.
        station: name of the station's process whose inputs count.
    """

    def __init__(self, bus: Bus, station: str) -> None:
        self.call = threading.Event()
        self._inputs = Senders(
            bus.subscribe(OPERATOR_INPUT, self.call), lambda held: held.holder if held.process == station else None
        )
        self._authority = bus.subscribe(AUTHORITY_STATE)

    def look(self, now_ns: int) -> Sitting:
        """Who sits there now."""
        stations = self._inputs.there(now_ns)
        authority = self._authority.fresh(now_ns)
        newest = sorted(stations.values(), key=lambda received: received.received_ns, reverse=True)
        for received in newest:
            if _confirms(authority, received.message):
                return Sitting(received.message, commands=True)
        return Sitting(newest[0].message if newest else None, commands=False)


def _confirms(authority: AuthorityState | None, operator: OperatorInput) -> bool:
    if authority is None or not authority.holder:
        return False
    return (authority.holder, authority.epoch) == (operator.holder, operator.epoch)
