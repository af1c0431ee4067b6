"""How the arm's command comes to its backend, and what is seen of it."""

import logging
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from services.robot.backends.backend import CONTROL_PERIOD, Backend, Blocked, NotReady, Observation, Status
from services.robot.homing import Homing, WayBlocked
from services.robot.starts import StartImpossible
from sim.pose import Pose

log = logging.getLogger(__name__)

Array = NDArray[np.float64]

LONGEST_FAULT = 200  # [characters]


class Drive:
    """Takes a backend through one control period after another; one that was stopped gets no command.

    Attributes:
        seen_object: where a camera saw the object last: what hardware is judged by, which does not know.
        homing: leads the arm to where motions start; None where it is put there at once, as a simulator can.

    Args:
        backend: what moves.
    """

    def __init__(self, backend: Backend) -> None:
        self._backend = backend
        self._stopped = False
        self._said = ""
        self.seen_object: Pose | None = None
        self.homing: Homing | None = None

    @property
    def goes_home(self) -> bool:
        """The arm is on its way to where motions start."""
        return self.homing is not None and self.homing.under_way

    def reset(self, start: Pose, place: Array, variant: str, q: Array, then: Callable[[], None]) -> None:
        """Put the arm at a start and everything in its place, at once or once it is there.

        Args:
            start: pose of the grasping frame at q, for whoever is told that no motion can start there.
            place: see `Backend.reset`.
            variant: see there.
            q: see there.
            then: what is done when all is in its place.

        Raises:
            StartImpossible: no motion can start there; nothing has changed.
        """

        def put_back() -> None:
            try:
                self._backend.reset(place, variant, q)
            except Blocked as error:
                raise StartImpossible(start.position, str(error)) from error
            then()

        if self.homing is None:
            put_back()
            return
        try:
            self.homing.begin(self._backend.observe().q, q, put_back)
        except WayBlocked as error:
            raise StartImpossible(start.position, str(error)) from error

    def period(self, q: Array, qd: Array, opening: float, given: Callable[[], None], *, held: bool = False) -> Array:
        """Command, and let the period pass; see `Backend.command`.

        Args:
            q: see there.
            qd: see there.
            opening: see there.
            given: called when the command has been handed over.
            held: nobody is present: an arm on its way to the start is led no further.

        Returns:
            The positions that were commanded: q, or those of the way to the start.

        Raises:
            NotReady: what moves has stopped by itself, or is not there any more.
        """
        if self.homing is not None and self.homing.under_way:
            if held:
                self.homing.stop()
            else:
                before, q = q, self.homing.advance()
                qd = (q - before) / CONTROL_PERIOD
        if not self._stopped:
            self._backend.command(q, qd, opening)
        given()
        self._backend.elapse()
        status = self._backend.status()
        if not (self._stopped or status.works):
            raise NotReady(status)
        return q

    def status(self) -> Status:
        """See `Backend.status`."""
        return self._backend.status()

    def close(self) -> None:
        """See `Backend.close`."""
        self._backend.close()

    def observe(self) -> Observation:
        """What is measured, and the object as it is known."""
        seen = self._backend.observe()
        return seen if seen.object_pose is not None else replace(seen, object_pose=self.seen_object)

    def stop(self, reason: str) -> None:
        """See `Backend.stop`; what is broken stands as well as it can."""
        self._stopped = True
        if self.homing is not None:
            self.homing.stop()
        try:
            self._backend.stop(reason)
        except Exception as error:  # noqa: BLE001 (whatever a driver raises: nothing more is commanded anyway)
            log.error(
                "the arm could not be told to stop (%s): it stands when its own controller misses commands", error
            )

    def recover(self) -> None:
        """See `Backend.recover`."""
        self._backend.recover()
        self._stopped = False

    def fault(self, error: Exception) -> str:
        """What is wrong with the arm, in one line, said once as long as it is the same."""
        fault = f"the arm failed ({type(error).__name__}: {' '.join(str(error).split())[:LONGEST_FAULT]})"
        if fault != self._said:
            log.error("%s", fault)
            log.debug("as raised", exc_info=error)
        self._said = fault
        return fault
