"""From operator to robot: the class `cmd`."""

from __future__ import annotations

from typing import Annotated

import msgspec

from protocol.messages.values import Count, Message, Name, Real, Vector3


class OperatorInput(Message, frozen=True, kw_only=True):
    """The FULL state of the operator's page inputs, never a change of it.

    Attributes:
        operator: the person at the page.
        holder: the station's name as holder of the authority.
        epoch: of the authority that the station holds; 0 while it holds none.
        present: the page is alive, visible and was heard within the last second.
        keys: the physical keys held down, by their `KeyboardEvent.code`.
        focused: the page has the focus; without it no key counts.
        axes: gamepad or pointer axes, each from -1 to 1.
    """

    operator: Name = ""
    holder: Name = ""
    epoch: Count = 0
    present: bool = False
    keys: Annotated[tuple[Name, ...], msgspec.Meta(max_length=32)] = ()
    focused: bool = False
    axes: Annotated[tuple[Real, ...], msgspec.Meta(max_length=16)] = ()


class MasterState(Message, frozen=True, kw_only=True):
    """The full state of the master device.

    Attributes:
        displacement: from the device's neutral position, in base axes [m].
        velocity: of the displacement [m/s].
        rotation: from the device's neutral orientation, rotation vector in base axes [rad].
        force: what the device renders to the hand (eq. 14) [N].
        engaged: a hand is on the device and the clutch is closed; displacement and rotation count only then.
        operator: the person whose hand it is, as the station says.
        holder: of the authority under which the master commands.
        epoch: of that authority.
        device: what kind of device this is.
    """

    displacement: Vector3 = (0.0, 0.0, 0.0)
    velocity: Vector3 = (0.0, 0.0, 0.0)
    rotation: Vector3 = (0.0, 0.0, 0.0)
    force: Vector3 = (0.0, 0.0, 0.0)
    engaged: bool = False
    operator: Name = ""
    holder: Name = ""
    epoch: Count = 0
    device: Name = ""
