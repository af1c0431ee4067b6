"""The robot's port of the network between hand and contact: the correction goes out of it, the contact force goes in.

See `lfd.passivity`. What goes in is the force of the environment times the step of the correction as it is applied,
period by period; in contact the correction is let no further against the force than the hand is known to have worked
for. The first sample of a touch cannot be foreseen: what it takes, at most `LARGEST` times the step, is a debt, and
while there is one the correction goes no further against the force. What was withheld is caught up with at the pace of
an unhurried hand, so that nothing jumps where a contact ends. Where none is felt, and for a device that renders no
contact force, nothing is changed at all. The correction's turn has no port: no torque is shown to a hand, so nothing
that the turn does comes back through the network.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lfd.passivity import Port
from protocol.messages import MasterState
from services.bus.arrays import vector3
from services.robot.clutch import FADE
from services.robot.correction import Correction
from services.robot.episode import Episode
from services.robot.safety import clamp_length

Array = NDArray[np.float64]

LARGEST = 20.0
"""Of the contact force that is told and counted [N]: harder is felt as this hard."""

SMOOTHED_S = 0.02
"""Time constant of the low-pass on what is told [s]: physics in contact rattles."""

CREDIT = 0.05
"""So much a contact may take before the hand is known to have worked for it [J]: 10 N over half a centimetre."""

NOTHING = 0.01
"""A force that has faded to less is over [N]."""


class ContactPort:
    """Between the operator's correction and what the robot touches.

    Args:
        period: of the control [s].

    Attributes:
        force: of the environment on the robot, bounded and low-passed, base axes, shape (3,) [N].
    """

    def __init__(self, period: float) -> None:
        self._fade = FADE * period
        self._share = -math.expm1(-period / SMOOTHED_S)
        self._port = Port(CREDIT)
        self._episode: Episode | None = None
        self._before: Array = np.zeros(3)
        self._withheld: Array = np.zeros(3)
        self._felt: Array = np.zeros(3)
        self.force: Array = np.zeros(3)

    @property
    def energy_in(self) -> float:
        """That contact did to the correction since the beginning [J]."""
        return self._port.energy_in

    def let_go(self) -> None:
        """The hand is off the master: taken up again it goes on from what is applied, with nothing withheld."""
        self._withheld = np.zeros(3)

    def limited(self, wanted: Correction, master: MasterState | None, episode: Episode | None) -> Correction:
        """The correction that may be asked for in this period.

        Args:
            wanted: by the operator.
            master: the newest that counts of the operator's device.
            episode: whose motion is corrected, None where none is.
        """
        if master is None or master.contact_energy < 0.0:
            episode = None
        if episode is not self._episode:
            self.let_go()
        self._episode = episode
        if master is None or episode is None:
            return wanted
        self._port.hear(master.publisher, master.contact_energy)
        applied = episode.execution.correction
        self._before = applied.offset
        if wanted.offset is applied.offset or not (self._felt.any() or self._withheld.any()):
            return wanted
        return replace(wanted, offset=self._let(wanted.offset))

    def observe(self, contact_force: Array) -> None:
        """A period has passed.

        Args:
            contact_force: of the environment on the robot in it, its mean, base axes, shape (3,) [N].
        """
        bounded, _ = clamp_length(contact_force, LARGEST)
        self.force = self.force + self._share * (bounded - self.force)
        told = float(np.linalg.norm(self.force))
        if not told > NOTHING:
            self.force = np.zeros(3)
        # A contact that is lost for a moment goes on to count, and one that has begun counts at once.
        self._felt = bounded if np.linalg.norm(bounded) > told else self.force
        if self._episode is not None:
            self._port.observe(-float(bounded @ (self._episode.execution.correction.offset - self._before)))

    def _let(self, wanted: Array) -> Array:
        """The offset that is let through of the wanted one, shape (3,) [m]."""
        caught_up, _ = clamp_length(self._withheld, self._fade)
        self._withheld = self._withheld - caught_up
        # All of the way at once is the most that the correction can go in a period.
        step = vector3(wanted - self._withheld - self._before)
        let = self._port.step(step, vector3(self._felt))
        if let is not step:
            self._withheld = wanted - (self._before + np.array(let))
        return wanted - self._withheld
