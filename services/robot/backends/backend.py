"""The seam between control and what moves: the simulation, or hardware in its place."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from services.process.exceptions import EnvironmentFault, ServiceError
from sim.pose import Pose

Array = NDArray[np.float64]

CONTROL_PERIOD = 0.010
"""Duration of one command [s]."""

SILENCE_S = 0.050
"""Without a command for so long a backend holds by itself [s]."""

FIRST_STEP = 0.05
"""By how much the first command may be away from the measured joints [rad, torso m]."""


class State(Enum):
    """What a backend does, or why it does nothing."""

    READY = "ready"  # it follows commands
    HOLDING = "holding"  # it stands by itself, and waits for a command that begins where it stands
    PROTECTIVE_STOP = "protective stop"  # its own controller stopped it: a collision, a limit
    HARDWARE_STOP = "hardware stop"  # a button on it is pressed, or its brakes are closed
    WRONG_MODE = "wrong mode"  # it is led by hand, or by its teach pendant
    NOT_CONNECTED = "not connected"


@dataclass(frozen=True)
class Status:
    """How a backend is.

    Attributes:
        state: what it does.
        age: of what it was measured from [s].
        reason: for people; empty where it is ready, or holds because nothing is commanded.
    """

    state: State
    age: float = 0.0
    reason: str = ""

    @property
    def works(self) -> bool:
        """It moves, or stands because it was told to."""
        return self.state in (State.READY, State.HOLDING)

    def __str__(self) -> str:
        """For people."""
        return self.state.value + (f": {self.reason}" if self.reason else "")


@dataclass(frozen=True, eq=False)
class NativeLimits:
    """What a backend itself keeps to, whatever is commanded; infinite where it keeps to nothing.

    Attributes:
        lower: least positions, shape (m,) [rad, torso m].
        upper: greatest positions, shape (m,).
        speed: greatest speeds, shape (m,) [rad/s].
        acceleration: greatest accelerations, shape (m,) [rad/s^2].
        jerk: greatest jerks, shape (m,) [rad/s^3].
        rate_hz: at which it takes targets from its own loop, which fills in what lies between commands.
    """

    lower: Array
    upper: Array
    speed: Array
    acceleration: Array
    jerk: Array
    rate_hz: float = 1.0 / CONTROL_PERIOD


@dataclass(frozen=True, eq=False)
class Touch:
    """The robot touches its environment; the object, the floor and the robot itself do not count.

    Attributes:
        position: in the base frame, shape (3,) [m].
        force: magnitude [N].
        between: the robot's link and the thing that it touches.
    """

    position: Array
    force: float
    between: tuple[str, str]


@dataclass(frozen=True, eq=False)
class Observation:
    """What is measured at the end of a control period.

    Attributes:
        time: of the backend's own clock since its reset [s].
        q: joint positions, in the order of `joint_names`, shape (m,) [rad, torso m].
        qd: joint velocities, shape (m,) [rad/s, torso m/s].
        object_pose: of the object's centre in the base frame, as a simulator knows it, to judge by; None on hardware,
            which does not know: there it is what the camera saw.
        touch: the strongest at any moment of the period, None where there was none.
        world: all generalised positions of a simulated world, to draw it; empty on hardware.
        condition: the external state that motions depend on here, shape (c,); empty where it is the object's.
        contact_force: of the environment on the robot, the mean over the period, in the base frame, shape (3,) [N];
            zero where it is not measured.
        opening: between the gripper's fingers [m]; 0 where there is no gripper.
        grasped: both of its fingers touched the object in the period.
    """

    time: float
    q: Array
    qd: Array
    object_pose: Pose | None
    touch: Touch | None
    world: Array
    condition: Array = field(default_factory=lambda: np.zeros(0))
    contact_force: Array = field(default_factory=lambda: np.zeros(3))
    opening: float = 0.0
    grasped: bool = False


class Blocked(ServiceError):
    """The arm cannot be put there: something stands in the way."""

    def __init__(self, link: str, thing: str) -> None:
        self.link = link
        self.thing = thing
        super().__init__(f"the robot's {link} would touch {thing}")


class NotReady(ServiceError):
    """The arm follows no commands now."""

    def __init__(self, status: Status) -> None:
        self.status = status
        super().__init__(f"the arm follows no commands ({status})")


class Jump(ServiceError):
    """A first command that does not begin where the arm is."""

    def __init__(self, joint: str, commanded: float, measured: float) -> None:
        self.joint = joint
        self.commanded = commanded
        self.measured = measured
        super().__init__(
            f"the first command is not where the arm stands: {joint} is at {measured:.3f}, not at {commanded:.3f}"
        )


class RobotNotAnswering(EnvironmentFault):
    """No robot answers where one is configured, or it lets nobody command it."""

    def __init__(self, robot: str, host: str, reason: str) -> None:
        self.robot = robot
        self.host = host
        self.reason = reason
        super().__init__(f"no {robot} arm can be commanded at {host}: {reason}")


def check_first(joint_names: Sequence[str], commanded: Array, measured: Array) -> None:
    """Let a first command pass that begins where the arm is.

    Args:
        joint_names: of the joints.
        commanded: positions, shape (m,).
        measured: positions, shape (m,).

    Raises:
        Jump: it does not, within `FIRST_STEP`.
    """
    gap = np.abs(commanded - measured)
    if not (gap <= FIRST_STEP).all():
        furthest = int(np.argmax(gap))
        raise Jump(joint_names[furthest], float(commanded[furthest]), float(measured[furthest]))


class Backend(Protocol):
    """One arm that follows joint commands, and stands whenever none comes."""

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Of every joint vector, in order."""
        ...

    @property
    def limits(self) -> NativeLimits:
        """What it keeps to by itself; of hardware known once it is connected."""
        ...

    @property
    def variant(self) -> str:
        """Which arrangement of the scene stands around the robot."""
        ...

    def connect(self) -> None:
        """Get hold of the arm, which stands; nothing else is asked of it before.

        Raises:
            RoomMissing: the vendor's library is not installed.
            RobotNotAnswering: no robot answers within a few seconds.
        """
        ...

    def close(self) -> None:
        """Let go of the arm, which stands from then on."""
        ...

    def status(self) -> Status:
        """How it is; measured, returned at once, and never an exception."""
        ...

    def hold(self) -> None:
        """Stand where it is; the next command has to begin there."""
        ...

    def stop(self, reason: str) -> None:
        """Stand at once, as fast as it can, and follow nothing until `recover`.

        A software stop is no safety-rated one.

        Args:
            reason: for people.
        """
        ...

    def recover(self) -> None:
        """Be ready again after a stop, its own controller's included; it does not move.

        Raises:
            NotReady: it cannot be, as long as somebody does not see to it at the robot.
        """
        ...

    def reset(self, place: Array, variant: str, q: Array) -> None:
        """Prepare an episode: the arm at rest at q, gripper wide open, the target and its surroundings in place.

        Args:
            place: of the target, as the scene counts it: an object's centre, or the y of via-points, shape (d,) [m].
            variant: arrangement of the scene.
            q: joint positions, shape (m,).

        Raises:
            Blocked: the arm would touch its environment there; nothing has changed.
        """
        ...

    def command(self, q: Array, qd: Array, opening: float) -> None:
        """Hand over the command for one control period; returns at once.

        The first one, and the first after a hold, a stop or a silence, has to be where the arm is. After `SILENCE_S`
        without another one the backend holds by itself.

        Args:
            q: joint positions at its end, shape (m,).
            qd: velocities towards them, shape (m,).
            opening: that the gripper goes to at its own speed, from 0, closed, to wide open [m].

        Raises:
            NotReady: it follows no commands.
            Jump: it is a first one, and not where the arm is.
        """
        ...

    def elapse(self) -> None:
        """Let the control period pass: simulated time does so by this alone, and that of hardware by itself."""
        ...

    def observe(self) -> Observation:
        """What is measured now."""
        ...
