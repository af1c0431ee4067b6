"""This operator's own path: how long what the hand does takes to the robot, and how old what comes back is."""

from __future__ import annotations

import msgspec

from protocol.messages import AuthorityState, Figure, OperatorInput, RobotState
from services.bus.stages import Lasting, Stages, stages
from services.station.ears import Camera, Ears, message, picture
from services.station.page.view import Picture


class OwnPath:
    """Of one station.

    Args:
        ears: what is heard.
        own: identity of this process.
        holder: the station's name as holder of the authority.
    """

    def __init__(self, ears: Ears, own: int, holder: str) -> None:
        self._ears = ears
        self._own = own
        self._holder = holder
        self._drawn = -1.0
        self._lasting = Lasting()

    def seen(self, held: OperatorInput) -> OperatorInput:
        """What is held, with the age of the drawn picture where anybody knows it: across machines the clocks decide."""
        self._drawn = held.drawn if self._ears.robot_clock(self._own) is not None else -1.0
        return msgspec.structs.replace(held, drawn=self._drawn)

    def stages(self, authority: AuthorityState | None, robot: RobotState | None, now_ns: int) -> Stages:
        """As they were measured in the last seconds; while somebody else commands only the picture is this operator's.

        Args:
            authority: who commands.
            robot: its newest state.
            now_ns: the time [ns].
        """
        seen = OperatorInput(drawn=self._drawn)
        if authority is None or authority.holder != self._holder:
            self._lasting.forget()
            return stages(seen)
        self._lasting.see(stages(seen, message(self._ears.master.latest()), robot), now_ns)
        return self._lasting.at(now_ns)

    def figures(self) -> tuple[Figure, ...]:
        """What this process alone knows of it."""
        return stages(OperatorInput(drawn=self._drawn)).figures()

    def picture(self, camera: Camera, now_ns: int) -> Picture | None:
        """See `picture`."""
        return picture(camera, now_ns, self._own, self._ears.robot_clock(self._own))
