"""UFACTORY's xArm 7, by the maker's SDK: joint velocities are streamed, each for 50 ms, which its controller smooths.

Tried against a stand-in for the library's interface only.
"""

import importlib
import logging
import math
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from services.process.exceptions import RoomMissing
from services.robot.backends.backend import SILENCE_S, NativeLimits, State
from services.robot.backends.driver import Reading, streamed
from services.robot.backends.hand import Hand
from services.robot.backends.sender import Sender

Array = NDArray[np.float64]

KIND, MODULE = "xarm", "xarm.wrapper"

VELOCITY_MODE = 4
READY, STOP = 0, 4  # states that can be set
STOPPED = frozenset({4, 5})  # states that are told in which nothing is followed
OPEN_PULSES, OPEN_M = 850.0, 0.085  # of the maker's gripper, wide open
FIRST_REPORT_S = 2.0

Open = Callable[[str], Any]


class Driver:
    """See `services.robot.backends.driver.Driver`.

    Args:
        open_arm: an `XArmAPI` in radians with the 100 Hz report, by host; the installed library's by default.
        seconds: what reports are stamped with, as they carry no time of their own [s].
    """

    maker = "UFACTORY"
    joints = 7

    def __init__(self, open_arm: Open | None = None, seconds: Callable[[], float] = time.monotonic) -> None:
        self._open = open_arm
        self._seconds = seconds
        self._arm: Any = None
        self._sender: Sender | None = None
        self._hand: Hand | None = None
        self._reports: list[tuple[float, list[float], int]] = []

    @property
    def limits(self) -> NativeLimits:
        """The maker's: one turn to each side or less, half a turn a second."""
        turn = 2.0 * math.pi
        lower = np.array([-turn, -2.059, -turn, -0.19198, -turn, -1.69297, -turn])
        upper = np.array([turn, 2.0944, turn, 3.927, turn, math.pi, turn])
        same = np.ones(self.joints)
        return NativeLimits(lower, upper, math.pi * same, 20.0 * same, 500.0 * same, rate_hz=250.0)

    def connect(self, host: str) -> None:
        """Reach the arm, and its gripper where it has one.

        Raises:
            RoomMissing: the SDK is not installed.
        """
        self._arm = arm = (self._open or _installed())(host)
        self._reports = []
        arm.register_report_callback(self._reported)
        due = time.monotonic() + FIRST_REPORT_S
        while not self._reports:
            if time.monotonic() > due:
                raise ConnectionError("it reports nothing")
            time.sleep(0.01)
        self._make_ready()
        self._sender = self._sender or Sender("xarm")
        code, _ = arm.get_gripper_position()
        if code == 0 and self._hand is None:
            self._hand = Hand(self._gripped, self._send)

    def close(self) -> None:
        """Let go of it."""
        if self._hand is not None:
            self._hand.close()
        if self._sender is not None:
            self._sender.close()
        self._arm.disconnect()
        self._arm = self._sender = self._hand = None

    def read(self) -> Reading:
        """The newest report; velocities are differences of the last two."""
        if self._sender is not None:
            self._sender.check()
        if not self._arm.connected:
            raise ConnectionError("its connection is lost")
        (before_s, before, _), (now_s, now, state) = self._reports[0], self._reports[-1]
        q = np.array(now)
        qd = (q - np.array(before)) / (now_s - before_s) if now_s > before_s else np.zeros(self.joints)
        told, reason = _told(state, self._arm.mode, self._arm.error_code)
        opening, grasped = (self._hand.opening, self._hand.grasped) if self._hand is not None else (0.0, False)
        return Reading(q, qd, stamp=now_s, state=told, reason=reason, opening=opening, grasped=grasped)

    def follow(self, q: Array, qd: Array, measured: Array) -> None:
        """Stream a velocity that the arm keeps for 50 ms at most."""
        self._stream(streamed(q, qd, measured, self.limits.speed))

    def grip(self, opening: float) -> None:
        """See `Hand`."""
        if self._hand is not None:
            self._hand.grip(opening)

    def stand(self) -> None:
        """Come to rest."""
        self._stream(np.zeros(self.joints))

    def recover(self) -> None:
        """Clear its error, and be ready for velocities again."""
        self._arm.clean_error()
        self._arm.clean_warn()
        self._make_ready()

    def _make_ready(self) -> None:
        arm = self._arm
        for code in (arm.motion_enable(enable=True), arm.set_mode(VELOCITY_MODE), arm.set_state(READY)):
            _checked(code)
        due = time.monotonic() + FIRST_REPORT_S
        while self._reports[-1][2] in STOPPED or arm.mode != VELOCITY_MODE:
            if time.monotonic() > due:
                break  # what it then says of itself tells why
            time.sleep(0.01)

    def _reported(self, report: dict[str, Any]) -> None:
        """On the SDK's thread: the newest two count."""
        self._reports = [
            *self._reports[-1:],
            (time.monotonic(), list(report["joints"])[: self.joints], report["state"]),
        ]

    def _stream(self, velocity: Array) -> None:
        speeds, arm = velocity.tolist(), self._arm
        if self._sender is not None:
            self._sender.give(
                lambda: _checked(arm.vc_set_joint_velocity(speeds, is_radian=True, is_sync=False, duration=SILENCE_S))
            )

    def _gripped(self) -> tuple[float, bool]:
        code, pulses = self._arm.get_gripper_position()
        _checked(code)
        return OPEN_M * float(pulses) / OPEN_PULSES, False

    def _send(self, told: float, wanted: float) -> None:
        del told
        _checked(self._arm.set_gripper_position(OPEN_PULSES * min(wanted, OPEN_M) / OPEN_M, wait=False))


def _installed() -> Open:
    """What opens an arm.

    Raises:
        RoomMissing: the SDK is not installed.
    """
    try:
        api = importlib.import_module(MODULE).XArmAPI
        # It writes a line for each call that fails, over whatever else is said.
        importlib.import_module("xarm.core.utils.log").logger.setLevel(logging.CRITICAL)
    except ImportError:
        raise RoomMissing(KIND, MODULE.partition(".")[0]) from None
    return lambda host: api(host, is_radian=True, report_type="real")


def _told(state: int, mode: int, error: int) -> tuple[State, str]:
    """What the arm's state, mode and error mean, and why."""
    if error in (1, 2, 3):
        return State.HARDWARE_STOP, "an emergency stop is pressed"
    if error or state in STOPPED:
        return State.PROTECTIVE_STOP, f"its controller stopped it (error {error}, state {state})"
    if mode != VELOCITY_MODE:
        return State.WRONG_MODE, f"it is in mode {mode}, not in that of joint velocities"
    return State.READY, ""


def _checked(code: int) -> None:
    if code != 0:
        raise ConnectionError(f"its controller did not take a command (code {code})")
