"""What a maker's file says of an arm: how it is reached, read and moved. The contract around it is `Hardware`'s."""

from collections.abc import Callable
from dataclasses import dataclass, field
from threading import Thread
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from services.process.exceptions import ServiceError
from services.robot.backends.backend import NativeLimits, RobotNotAnswering, State

Array = NDArray[np.float64]
T = TypeVar("T")

ANSWER_S = 4.0
"""A robot that has not answered within this time is not there [s]."""

GAIN = 10.0
"""Of the distance to the commanded positions on the velocity that a driver streams [1/s]."""


@dataclass(frozen=True, eq=False)
class Reading:
    """What an arm says of itself.

    Attributes:
        q: joint positions, shape (m,) [rad].
        qd: joint velocities, shape (m,) [rad/s].
        stamp: of the arm's own clock [s]; the same one twice is the same reading.
        state: `READY` where it would follow a command, else why not.
        reason: of that, for people.
        force: of the environment on the gripper, in the frame of the arm's first link, shape (3,) [N]; zero where it is
            not measured.
        opening: of the gripper [m]; 0 where there is none.
        grasped: the gripper holds something.
    """

    q: Array
    qd: Array
    stamp: float
    state: State = State.READY
    reason: str = ""
    force: Array = field(default_factory=lambda: np.zeros(3))
    opening: float = 0.0
    grasped: bool = False


class Driver(Protocol):
    """One maker's arms. Nothing but `connect` and `recover` waits.

    Attributes:
        maker: for people.
        joints: how many an arm has.
    """

    maker: str
    joints: int

    @property
    def limits(self) -> NativeLimits:
        """What the arm itself keeps to; known once it is connected."""
        ...

    def connect(self, host: str) -> None:
        """Reach the arm; what it raises, besides `RoomMissing`, is why it cannot be."""
        ...

    def close(self) -> None:
        """Let go of it."""
        ...

    def read(self) -> Reading:
        """What it says now; what it raises means that it is not heard any more."""
        ...

    def follow(self, q: Array, qd: Array, measured: Array) -> None:
        """Move towards q, shape (m,) [rad], at qd, shape (m,) [rad/s]; without another call it stands 50 ms later."""
        ...

    def grip(self, opening: float) -> None:
        """Let the gripper go there [m]."""
        ...

    def stand(self) -> None:
        """Come to rest as fast as the arm can."""
        ...

    def recover(self) -> None:
        """Clear what its own controller stopped it for; it does not move."""
        ...


def reached(maker: str, host: str, connect: Callable[[], T], within_s: float = ANSWER_S) -> T:
    """What `connect` gives; the makers' own patience is up to a minute.

    Raises:
        RobotNotAnswering: it gave nothing in time, or raised something that is not known here.
    """
    given: list[T] = []
    raised: list[Exception] = []

    def attempt() -> None:
        try:
            given.append(connect())
        except Exception as error:  # noqa: BLE001 (whatever a maker's library raises, it is told in a line)
            raised.append(error)

    # A daemon: what hangs in a maker's library must not keep the process from ending.
    attempting = Thread(target=attempt, name=f"reaches {host}", daemon=True)
    attempting.start()
    attempting.join(within_s)
    if given:
        return given[0]
    if raised and isinstance(raised[0], ServiceError):
        raise raised[0]
    reason = " ".join(str(raised[0]).split()) if raised else f"no answer within {within_s:.0f} s"
    raise RobotNotAnswering(maker, host, f"{reason}: see that it is on, in reach, and lets this computer command it")


def streamed(q: Array, qd: Array, measured: Array, fastest: Array) -> Array:
    """The velocity that leads measured joints to q at qd, shape (m,) [rad/s].

    Args:
        q: positions to be at, shape (m,).
        qd: velocities there, shape (m,).
        measured: positions now, shape (m,).
        fastest: that the joints may be, shape (m,).
    """
    wanted = qd + GAIN * (q - measured)
    return np.minimum(np.maximum(wanted, -fastest), fastest)
