"""From operator to robot: the class `cmd`."""

from __future__ import annotations

from enum import Enum
from typing import Annotated

import msgspec

from protocol.messages.values import Count, Fraction, Message, Name, Real, Vector3

Reading = Annotated[float, msgspec.Meta(ge=-1e3, le=1e3)]
Yaw = Annotated[float, msgspec.Meta(ge=-3.1416, le=3.1416)]


class Controller(msgspec.Struct, frozen=True):
    """A device beside the keys, as it is read: nothing is scaled, and nothing left out.

    Attributes:
        kind: "gamepad", "spacemouse", or "pointer", which is the pad on the page.
        number: tells two of a kind apart.
        name: as browser or driver call it.
        standard: axes and buttons come in the order of the W3C's standard gamepad.
        axes: each from -1 to 1; a pointer's count on without end, in halves of its pad.
        buttons: how far each is pressed.
    """

    kind: Name
    number: Annotated[int, msgspec.Meta(ge=0, le=99)] = 0
    name: Name = ""
    standard: bool = False
    axes: Annotated[tuple[Reading, ...], msgspec.Meta(max_length=16)] = ()
    buttons: Annotated[tuple[Fraction, ...], msgspec.Meta(max_length=32)] = ()


class Trouble(Enum):
    """Why a master counts for nothing though its operator is there, or what of it does not count.

    TWO: two devices are used at once.
    GONE: the device that was used last is there no more.
    NOT_AT_REST: a device has not been at rest since it came.
    ABSENT: the device that is configured is not there.
    BLIND: the cameras' pictures are too old to correct by.
    """

    NONE = "none"
    TWO = "two"
    GONE = "gone"
    NOT_AT_REST = "not_at_rest"
    ABSENT = "absent"
    BLIND = "blind"


class OperatorInput(Message, frozen=True, kw_only=True):
    """The FULL state of the operator's page inputs, never a change of it.

    Attributes:
        operator: the person at the page.
        holder: the station's name as holder of the authority.
        epoch: of the authority that the station holds; 0 while it holds none.
        present: the page is alive, visible and was heard within the last second.
        keys: the physical keys held down, by their `KeyboardEvent.code`.
        focused: the page has the focus; without it no key counts.
        late: the page was not heard for a moment, so that no key counts now; what is held all the while goes on as soon
            as it is heard again, while after a loss of the focus everything has to be let go first.
        controllers: what else the page reads beside the keys.
        yaw: of the person's axes in the base frame [rad]: what s/he sees as forward lies so far to the left of the
            robot's. Devices take it over once everything was let go.
        blind: the newest pictures that the station has are too old to correct by.
        captured_ns: when the browser read what is held, by the station's clock, as well as round trips tell [ns]; 0
            where that is not known.
        drawn: age of the newest picture of a camera when the browser had drawn it, from its capture [s]; negative where
            that is not known.
        opening: that the operator has asked of the gripper in this episode, as a share of wide open; None where s/he
            has not, or where it takes no part.
    """

    operator: Name = ""
    holder: Name = ""
    epoch: Count = 0
    present: bool = False
    keys: Annotated[tuple[Name, ...], msgspec.Meta(max_length=32)] = ()
    focused: bool = False
    late: bool = False
    controllers: Annotated[tuple[Controller, ...], msgspec.Meta(max_length=4)] = ()
    yaw: Yaw = 0.0
    blind: bool = False
    captured_ns: Annotated[int, msgspec.Meta(ge=0, le=2**63 - 1)] = 0
    drawn: Real = -1.0
    opening: Fraction | None = None


class MasterState(Message, frozen=True, kw_only=True):
    """The full state of the master device.

    Attributes:
        displacement: from the device's neutral position, in base axes [m].
        velocity: of the displacement [m/s].
        rotation: from the device's neutral orientation, rotation vector in base axes [rad].
        force: what the device renders to the hand: eq. 14, and the contact force of the robot [N].
        engaged: a hand is on the device and the clutch is closed; displacement and rotation count only then.
        operator: the person whose hand it is, as the station says.
        holder: of the authority under which the master commands.
        epoch: of that authority.
        device: what kind of device this is; where there are several, the one in use.
        actions: of the teaching workflow, whose buttons on the device are held down.
        trouble: why the device counts for nothing, or what of it.
        trouble_with: the device that the trouble is with.
        yaw: of the axes along which the hand pushes, see `OperatorInput` [rad]; displacement and rotation are in base
            axes whatever it is.
        echoed_ns: the stamp on the newest robot state that the master had heard, so that the robot knows the round
            trip [ns]; 0 before the first.
        echo_held_ns: how long before this state it had come [ns].
        contact_energy: that the hand put in against the contact force, since the process started [J], see
            `lfd.passivity`; negative where the device renders none, and then no contact limits the correction.
        capture: from when the page read what was held there to the first sample that follows it, of the newest change
            [s]; negative where that is not known.
        opening: that the operator asks of the gripper, as a share of wide open; None leaves it as it is, and to the
            motion. Once asked it stays so through whatever is lost meanwhile, focus, tab or link, as an object must
            not be dropped for that, and counts until the motion itself comes to it; a new episode begins with None.
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
    actions: Annotated[tuple[Name, ...], msgspec.Meta(max_length=8)] = ()
    trouble: Trouble = Trouble.NONE
    trouble_with: Name = ""
    yaw: Yaw = 0.0
    echoed_ns: Annotated[int, msgspec.Meta(ge=0, le=2**63 - 1)] = 0
    echo_held_ns: Count = 0
    contact_energy: Annotated[float, msgspec.Meta(ge=-1.0, le=1e9)] = -1.0
    capture: Real = -1.0
    opening: Fraction | None = None
