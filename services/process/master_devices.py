"""The input devices that a configuration can name: `[master.device] kind`."""

from __future__ import annotations

from typing import Annotated

import msgspec

from services.process.section import Positive, Section


class _Led(Section, frozen=True):
    """A device whose keys, sticks or drags lead a displacement and a rotation.

    Attributes:
        growth: of the displacement while a key is held or a stick deflected all the way [m/s].
        decay: of the displacement without [m/s].
        reach: largest displacement along each axis; a pointer goes there in half of its pad [m].
        turn_growth: of the rotation while a key is held [rad/s].
        turn_decay: of the rotation without [rad/s].
        turn_reach: largest rotation about each axis [rad].
        profile: name of the only profile that counts of a person's; empty for those that fit the devices.
    """

    growth: Positive = 0.12
    decay: Positive = 0.05
    reach: Positive = 0.25
    turn_growth: Positive = 0.4
    turn_decay: Positive = 0.2
    turn_reach: Positive = 0.8
    profile: str = ""


class Page(_Led, frozen=True, tag_field="kind", tag="page"):
    """Whichever device is used in the operator's page: keys, a gamepad, a 3-D mouse or the pointer on its pad."""


class Keyboard(_Led, frozen=True, tag_field="kind", tag="keyboard"):
    """The keys of the operator's page, and nothing else."""


class Gamepad(_Led, frozen=True, tag_field="kind", tag="gamepad"):
    """A gamepad that the operator's browser reads, and nothing else."""


class Pointer(_Led, frozen=True, tag_field="kind", tag="pointer"):
    """Mouse or pen on the pad of the operator's page, in place of a stylus, and nothing else."""


class SpaceMouse(_Led, frozen=True, tag_field="kind", tag="spacemouse"):
    """A 3-D mouse at the master's own computer."""


class Phantom(Section, frozen=True, tag_field="kind", tag="phantom"):
    """A Phantom Omni or Touch at the master's own computer.

    Attributes:
        stiffness: of the force feedback (eq. 14) [N/m].
        damping: of the force feedback [N s/m].
        force_limit: largest force that it renders, within what the motors can [N].
        profile: name of the only profile that counts of a person's; empty for the one that fits.
    """

    stiffness: Positive = 50.0
    damping: Positive = 2.0
    force_limit: Annotated[Positive, msgspec.Meta(le=5.0)] = 3.0
    profile: str = ""


class Scripted(Section, frozen=True, tag_field="kind", tag="scripted"):
    """A simulated haptic stylus moved by the forces of a simulated hand.

    Attributes:
        stiffness: of the force feedback (eq. 14) [N/m].
        damping: of the force feedback [N s/m].
        force_limit: largest force that it renders [N].
        exaggeration: of the correction; 1 is natural.
        scatter: root mean square of the distance between two ways that the person means alike; people's are 0.018 to
            0.052 [m].
        misjudgement: standard deviation of the error of the depth that they see [m].
    """

    stiffness: Positive = 50.0
    damping: Positive = 2.0
    force_limit: Positive = 20.0
    exaggeration: Positive = 1.0
    scatter: Annotated[float, msgspec.Meta(ge=0.0, le=0.2)] = 0.030
    misjudgement: Annotated[float, msgspec.Meta(ge=0.0, le=0.1)] = 0.010


Led = Page | Keyboard | Gamepad | Pointer | SpaceMouse
"""Those that a hand leads by keys, sticks or drags."""

MasterDevice = Led | Phantom | Scripted
"""Whatever a master process can own."""
