"""What a master device is to the process that owns it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from protocol.messages import Figure, Mode, OperatorInput, RobotState, Trouble, Vector3

ZERO: Vector3 = (0.0, 0.0, 0.0)

Episode = tuple[int, int]
"""The robot process' identity and its number for the episode."""


@dataclass(frozen=True)
class Moment:
    """What the process knows at one step; what is too old to count is None.

    Attributes:
        now_ns: the process' clock [ns].
        dt: since the step before [s].
        operator: the inputs of the operator's page.
        robot: what the robot is doing.
        commands: the operator's station holds the authority.
    """

    now_ns: int
    dt: float
    operator: OperatorInput | None
    robot: RobotState | None
    commands: bool

    @property
    def refining(self) -> RobotState | None:
        """The robot's state, while it executes an episode that an operator may correct."""
        return self._led(Mode.REFINE)

    @property
    def teaching(self) -> RobotState | None:
        """The robot's state, while an operator's hand leads it without a prediction."""
        return self._led(Mode.TEACH)

    def _led(self, mode: Mode) -> RobotState | None:
        robot = self.robot
        led = robot is not None and self.commands and robot.mode is mode and robot.phase.running
        return robot if led else None


@dataclass(frozen=True)
class Sample:
    """The full state of a device, in base axes.

    Attributes:
        displacement: from neutral [m].
        velocity: of the displacement [m/s].
        rotation: from neutral, rotation vector [rad].
        force: rendered to the hand [N].
        engaged: a hand is on the device, and displacement and rotation count.
        actions: of the teaching workflow, whose buttons on the device are held.
        trouble: why the device counts for nothing, or what of it.
        trouble_with: the device that the trouble is with.
        yaw: of the axes along which the hand pushes, in base axes [rad].
        contact_energy: that the hand put in against the contact force [J]; negative where none is rendered.
        opening: that the hand asks of the gripper, as a share of wide open; None where it asks for nothing, and what
            the operator's station says counts.
    """

    displacement: Vector3 = ZERO
    velocity: Vector3 = ZERO
    rotation: Vector3 = ZERO
    force: Vector3 = ZERO
    engaged: bool = False
    actions: tuple[str, ...] = ()
    trouble: Trouble = Trouble.NONE
    trouble_with: str = ""
    yaw: float = 0.0
    contact_energy: float = -1.0
    opening: float | None = None


class Device(Protocol):
    """One input device."""

    @property
    def name(self) -> str:
        """What kind of device it is; where there are several, the one in use."""
        ...

    def step(self, moment: Moment) -> Sample | None:
        """Bring the device up to now; None keeps a robot that holds where it is. Must not wait."""
        ...

    def figures(self) -> tuple[Figure, ...]:
        """What was measured since the last call."""
        ...

    def close(self) -> None:
        """Let go of the hardware."""
        ...
