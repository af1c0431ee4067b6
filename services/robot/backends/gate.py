"""Which commands a backend lets pass: the part of the contract that is the same for all of them."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from services.robot.backends.backend import SILENCE_S, NotReady, State, Status, check_first

Array = NDArray[np.float64]

_ROUNDING = 1e-9  # [s] of sums of control periods


class Gate:
    """Knows whether a backend is connected, stopped, or left without a command; times are the backend's own [s].

    Args:
        joint_names: of the joints.
        measured: says where they are, shape (m,).
    """

    def __init__(self, joint_names: tuple[str, ...], measured: Callable[[], Array]) -> None:
        self._joint_names = joint_names
        self._measured = measured
        self._connected = False
        self._stopped = ""
        self._commanded: float | None = None

    def connect(self) -> None:
        """The arm is there, and stands."""
        self._connected, self._stopped, self._commanded = True, "", None

    def close(self) -> None:
        """It is not there any more."""
        self._connected, self._commanded = False, None

    def hold(self) -> None:
        """What comes next is a first command."""
        self._commanded = None

    def stop(self, reason: str) -> None:
        """Nothing passes until `recover`; a stop that is there already keeps its reason."""
        self._stopped = self._stopped or reason or "stopped"
        self._commanded = None

    def recover(self) -> None:
        """What comes next passes, where it begins where the arm is."""
        self._stopped = ""

    def admit(self, q: Array, now: float) -> None:
        """Let a command pass.

        Args:
            q: that it leads to, shape (m,).
            now: the time.

        Raises:
            NotReady: the backend is not connected, or stopped.
            Jump: see `check_first`.
        """
        if not self._connected or self._stopped:
            raise NotReady(self.status(now))
        if self.silent(now):
            check_first(self._joint_names, q, self._measured())
        self._commanded = now

    def silent(self, now: float) -> bool:
        """Nothing is commanded, or not any more: the arm is to stand."""
        return self._commanded is None or now - self._commanded >= SILENCE_S - _ROUNDING

    def status(self, now: float) -> Status:
        """How the backend is, as far as that follows from what it was told."""
        if not self._connected:
            return Status(State.NOT_CONNECTED)
        if self.silent(now):
            return Status(State.HOLDING, reason=self._stopped)
        return Status(State.READY)
