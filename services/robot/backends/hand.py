"""A gripper whose maker's calls wait until it is there: a thread of its own makes them."""

import logging
from collections.abc import Callable
from threading import Event, Thread

log = logging.getLogger(__name__)

WORTH_IT = 0.002  # [m] by which an opening has to change to be told
POLL_S = 0.05


class Hand:
    """Sends a gripper to the newest opening that was asked for, one after the other, and asks it how far it is open.

    Args:
        read: how far it is open [m], and whether it holds something; may wait.
        go: lets it go from the first opening to the second one [m]; may wait.
    """

    def __init__(self, read: Callable[[], tuple[float, bool]], go: Callable[[float, float], None]) -> None:
        self._read = read
        self._go = go
        self.opening, self.grasped = read()
        self._wanted = self._told = self.opening
        self._end = Event()
        self._thread = Thread(target=self._run, name="gripper", daemon=True)
        self._thread.start()

    def grip(self, opening: float) -> None:
        """Where it is to go; the newest counts."""
        self._wanted = opening

    def close(self) -> None:
        """Ask nothing more of it."""
        self._end.set()

    def _run(self) -> None:
        said = ""
        while not self._end.wait(POLL_S):
            try:
                wanted, told = self._wanted, self._told
                if abs(wanted - told) > WORTH_IT:
                    self._told = wanted
                    self._go(told, wanted)
                self.opening, self.grasped = self._read()
            except Exception as error:  # noqa: BLE001 (whatever a maker's library raises: the arm goes on without)
                if said != str(error):
                    said = str(error)
                    log.warning("the gripper does not do as it is told: %s", " ".join(said.split()))
