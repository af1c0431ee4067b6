"""Universal Robots' arms, by ur_rtde: positions are streamed by `servoJ`, which the controller follows smoothly.

Tried against a stand-in for the library's interface only. Its servo stands at the last position where none comes any
more; its watchdog ends its program where this process is gone.
"""

import importlib
import math
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from services.process.exceptions import RoomMissing
from services.robot.backends.backend import CONTROL_PERIOD, NativeLimits, NotReady, State, Status
from services.robot.backends.driver import Reading
from services.robot.backends.sender import Sender

Array = NDArray[np.float64]

KIND, MODULES = "ur", ("rtde_control", "rtde_receive", "dashboard_client")

LOOK_AHEAD_S = 0.05  # [s] over which the controller smooths, from 0.03 to 0.2
SERVO_GAIN = 500.0  # of its servo, from 100 to 2000
DECELERATION = 10.0  # [rad/s^2] of a stop
WATCHDOG_HZ = 10.0
RUNNING = 7  # robot mode: brakes released, ready
SAFEGUARD = 5  # safety mode
MODES = ("disconnected", "to be confirmed", "booting", "powered off", "powered on", "idle, its brakes closed", "pushed")


class Vendor(Protocol):
    """What of the library is used, by host."""

    def control(self, host: str) -> Any:
        """A `RTDEControlInterface`."""
        ...

    def receive(self, host: str) -> Any:
        """A `RTDEReceiveInterface`."""
        ...

    def dashboard(self, host: str) -> Any:
        """A `DashboardClient` that is connected."""
        ...


class Driver:
    """See `services.robot.backends.driver.Driver`. Its gripper is nobody's business here: makers differ.

    Args:
        vendor: of the library; the one that is installed by default.
    """

    maker = "Universal Robots"
    joints = 6

    def __init__(self, vendor: Vendor | None = None) -> None:
        self._vendor = vendor
        self._host = ""
        self._control: Any = None
        self._receive: Any = None
        self._sender: Sender | None = None

    @property
    def limits(self) -> NativeLimits:
        """One turn to each side and half a turn a second; what it accelerates by, its maker does not say."""
        turn, unknown = np.full(self.joints, 2.0 * math.pi), np.full(self.joints, np.inf)
        return NativeLimits(-turn, turn, np.full(self.joints, math.pi), unknown, unknown, rate_hz=500.0)

    def connect(self, host: str) -> None:
        """Reach the arm, and load the library's program into its controller.

        Raises:
            RoomMissing: ur_rtde is not installed.
        """
        vendor = self._vendor or _Installed()
        self._host, self._vendor = host, vendor
        self._receive = vendor.receive(host)
        self._control = vendor.control(host)
        self._control.setWatchdog(WATCHDOG_HZ)
        self._sender = self._sender or Sender("ur")

    def close(self) -> None:
        """Stop, and let go of the controller."""
        if self._sender is not None:
            self._sender.close(self._control.stopScript)
        self._control.disconnect()
        self._receive.disconnect()
        self._control = self._receive = self._sender = None

    def read(self) -> Reading:
        """The newest of what the library's own thread receives."""
        if self._sender is not None:
            self._sender.check()
        receive = self._receive
        if not receive.isConnected():
            raise ConnectionError("its connection is lost")
        self._control.kickWatchdog()
        state, reason = self._told()
        x, y, z = receive.getActualTCPForce()[:3]
        return Reading(
            np.array(receive.getActualQ()),
            np.array(receive.getActualQd()),
            stamp=receive.getTimestamp(),
            state=state,
            reason=reason,
            # The controller's frame is turned by half a turn against the first link's.
            force=np.array([-x, -y, z]),
        )

    def follow(self, q: Array, qd: Array, measured: Array) -> None:
        """Servo to a position."""
        del qd, measured
        target, control = q.tolist(), self._control
        self._give(lambda: _done(control.servoJ(target, 0.0, 0.0, CONTROL_PERIOD, LOOK_AHEAD_S, SERVO_GAIN)))

    def grip(self, opening: float) -> None:
        """It has none that this knows of."""

    def stand(self) -> None:
        """Come to rest."""
        control = self._control
        self._give(lambda: _done(control.servoStop(DECELERATION)))

    def recover(self) -> None:
        """Unlock a protective stop, and load the program again where it has ended."""
        if self._receive.isProtectiveStopped() and self._vendor is not None:
            self._vendor.dashboard(self._host).unlockProtectiveStop()
        if not self._control.isProgramRunning() and not self._control.reuploadScript():
            raise NotReady(
                Status(State.WRONG_MODE, 0.0, "its controller does not take the program: set remote control")
            )

    def _give(self, call: Any) -> None:
        if self._sender is not None:
            self._sender.give(call)

    def _told(self) -> tuple[State, str]:
        receive = self._receive
        if receive.isEmergencyStopped():
            return State.HARDWARE_STOP, "an emergency stop is pressed"
        if receive.isProtectiveStopped():
            return State.PROTECTIVE_STOP, "it met something, or a limit of its own"
        if receive.getSafetyMode() == SAFEGUARD:
            return State.HARDWARE_STOP, "its safeguard is open"
        mode = receive.getRobotMode()
        if mode != RUNNING:
            named = MODES[mode] if 0 <= mode < len(MODES) else f"in its mode {mode}"
            return State.WRONG_MODE, f"it is {named}"
        if not self._control.isProgramRunning():
            return State.WRONG_MODE, "the program in its controller has ended"
        return State.READY, ""


class _Installed:
    """See `Vendor`.

    Raises:
        RoomMissing: ur_rtde is not installed.
    """

    def __init__(self) -> None:
        try:
            self._control, self._receive, self._dashboard = map(importlib.import_module, MODULES)
        except ImportError:
            raise RoomMissing(KIND, MODULES[0]) from None

    def control(self, host: str) -> Any:
        """See `Vendor.control`."""
        return self._control.RTDEControlInterface(host)

    def receive(self, host: str) -> Any:
        """See `Vendor.receive`."""
        return self._receive.RTDEReceiveInterface(host)

    def dashboard(self, host: str) -> Any:
        """See `Vendor.dashboard`."""
        client = self._dashboard.DashboardClient(host)
        client.connect()
        return client


def _done(done: bool) -> None:
    if not done:
        raise ConnectionError("its controller did not take a command")
