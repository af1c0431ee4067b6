"""The buttons of the operator's device, as presses of the page's: one that is held down is one press."""

from __future__ import annotations

from protocol.messages import MasterState
from services.bus.subscription import Subscription
from services.station.press import Press


class DeviceButtons:
    """Hears which buttons are held on the device that this station's operator leads the robot with.

    Args:
        master: what the masters say.
        holder: this station's name as holder of the authority.
    """

    def __init__(self, master: Subscription[MasterState], holder: str) -> None:
        self._master = master
        self._holder = holder
        self._held: frozenset[str] | None = None

    def take(self, now_ns: int) -> list[Press]:
        """What has been pressed since the last call; what was held when the device was first heard was not."""
        state = self._master.fresh(now_ns)
        if state is None or state.holder != self._holder:
            self._held = None
            return []
        before, self._held = self._held, frozenset(state.actions)
        return [] if before is None else [Press(action) for action in sorted(self._held - before)]
