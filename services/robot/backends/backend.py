"""The seam between control and what moves: the simulation, or hardware in its place."""

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from services.process.exceptions import ServiceError
from sim.pose import Pose

Array = NDArray[np.float64]

CONTROL_PERIOD = 0.010
"""Duration of one command [s]."""


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
        object_pose: of the object's centre in the base frame.
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
    object_pose: Pose
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


class Backend(Protocol):
    """One arm that follows joint commands."""

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Of every joint vector, in order."""
        ...

    @property
    def variant(self) -> str:
        """Which arrangement of the scene stands around the robot."""
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

        Args:
            q: positions at its end, shape (m,).
            qd: velocities towards them, shape (m,).
            opening: that the gripper goes to, from 0, closed, to wide open [m].
        """
        ...

    def elapse(self) -> None:
        """Let the control period pass: simulated time does so by this alone, and that of hardware by itself."""
        ...

    def observe(self) -> Observation:
        """What is measured now."""
        ...
