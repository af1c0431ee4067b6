"""Franka's arms, by franky on libfranka: velocities are streamed, which the arm's own controller smooths at 1 kHz.

Its controller stops it where commands stop coming, whether this process is busy, killed or cut off.
"""

import importlib
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from services.process.exceptions import RoomMissing
from services.robot.backends.backend import SILENCE_S, NativeLimits, State
from services.robot.backends.driver import Reading, streamed
from services.robot.backends.hand import Hand

Array = NDArray[np.float64]

KIND, MODULE = "franka", "franky"

HAND_SPEED = 0.1  # [m/s]
HAND_FORCE = 30.0  # [N]


class Driver:
    """See `services.robot.backends.driver.Driver`."""

    maker = "Franka"
    joints = 7

    def __init__(self) -> None:
        self._franky: Any = None
        self._robot: Any = None
        self._hand: Hand | None = None
        self._limits: NativeLimits | None = None

    @property
    def limits(self) -> NativeLimits:
        """Of the arm that is connected: they differ from one generation to the next."""
        if self._limits is None:
            raise RuntimeError("not connected")
        return self._limits

    def connect(self, host: str) -> None:
        """Reach the arm, and the hand where it has one.

        Raises:
            RoomMissing: franky is not installed.
        """
        franky = self._franky = vendor()
        config = franky.RealtimeConfig
        realtime = config.Enforce if _is_realtime() else config.Ignore
        self._robot = robot = franky.Robot(host, realtime_config=realtime)
        lower, upper = _ends(robot.model_urdf)
        self._limits = NativeLimits(
            lower,
            upper,
            np.array(robot.joint_velocity_limit.max),
            np.array(robot.joint_acceleration_limit.max),
            np.array(robot.joint_jerk_limit.max),
            rate_hz=1e3,
        )
        try:
            gripper = franky.Gripper(host)
        except franky.Exception:
            return  # a flange without a hand
        self._hand = Hand(lambda: _gripped(gripper), lambda told, wanted: _send(gripper, told, wanted))

    def close(self) -> None:
        """The arm's controller notices."""
        if self._hand is not None:
            self._hand.close()
        self._robot = self._hand = None

    def read(self) -> Reading:
        """The newest state; while the arm is commanded that is at hand, else it is a millisecond away."""
        seen, hand = self._robot.state, self._hand
        state, reason = self._told(seen)
        return Reading(
            np.array(seen.q),
            np.array(seen.dq),
            stamp=seen.time.to_sec(),
            state=state,
            reason=reason,
            force=np.array(seen.O_F_ext_hat_K[:3]),
            opening=hand.opening if hand is not None else 0.0,
            grasped=hand is not None and hand.grasped,
        )

    def follow(self, q: Array, qd: Array, measured: Array) -> None:
        """Stream a velocity that the arm keeps for 50 ms at most."""
        wanted = streamed(q, qd, measured, self.limits.speed)
        held = self._franky.Duration(round(1e3 * SILENCE_S))
        self._robot.move(self._franky.JointVelocityMotion(wanted, duration=held), asynchronous=True)

    def grip(self, opening: float) -> None:
        """See `Hand`."""
        if self._hand is not None:
            self._hand.grip(opening)

    def stand(self) -> None:
        """Come to rest within the limits of acceleration and jerk."""
        self._robot.move(self._franky.JointVelocityStopMotion(), asynchronous=True)

    def recover(self) -> None:
        """Clear a reflex."""
        if self._robot.has_errors:
            self._robot.recover_from_errors()

    def _told(self, seen: Any) -> tuple[State, str]:
        """What the arm's mode means, and why it is in it."""
        modes = self._franky.RobotMode
        match seen.robot_mode:
            case modes.Idle | modes.Move:
                return State.READY, ""
            case modes.Reflex:
                return State.PROTECTIVE_STOP, f"{seen.last_motion_errors or 'a reflex'}"
            case modes.UserStopped:
                return State.HARDWARE_STOP, "its user stop is pressed"
            case modes.Guiding:
                return State.WRONG_MODE, "it is guided by hand"
            case modes.AutomaticErrorRecovery:
                return State.PROTECTIVE_STOP, "it recovers from an error"
            case _:
                return State.WRONG_MODE, "its brakes are closed, or commands from outside are not allowed"


def vendor() -> Any:
    """Franky.

    Raises:
        RoomMissing: it is not installed.
    """
    try:
        return importlib.import_module(MODULE)
    except ImportError:
        raise RoomMissing(KIND, MODULE) from None


def _is_realtime() -> bool:
    """This computer's kernel is one for real time, as the maker asks for."""
    flag = Path("/sys/kernel/realtime")
    return flag.exists() and flag.read_text().strip() == "1"


def _ends(urdf: str) -> tuple[Array, Array]:
    """Least and greatest positions of the seven joints, each of shape (7,) [rad], as the arm describes itself."""
    joints = [joint for joint in ElementTree.fromstring(urdf).iter("joint") if joint.get("type") == "revolute"]
    limits = [limit.attrib for limit in (joint.find("limit") for joint in joints) if limit is not None]
    ends = [(float(limit["lower"]), float(limit["upper"])) for limit in limits]
    lower, upper = np.array(ends[: Driver.joints]).T
    return lower, upper


def _gripped(gripper: Any) -> tuple[float, bool]:
    state = gripper.state
    return state.width, state.is_grasped


def _send(gripper: Any, told: float, wanted: float) -> None:
    """Open, or close with a force on whatever comes between the fingers."""
    if wanted >= told:
        gripper.move(wanted, HAND_SPEED)
    else:
        gripper.grasp(wanted, HAND_SPEED, HAND_FORCE, epsilon_inner=told, epsilon_outer=told)
