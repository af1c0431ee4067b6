"""What a browser tab says: who it is, what is held down in it, and what was pressed."""

from __future__ import annotations

from typing import Annotated

import msgspec

from protocol.exceptions import MalformedMessage, OversizedMessage
from protocol.messages import Controller, Count, Name, Reason, Yaw

MAX_BYTES = 4_096

_SUBJECT = "the operator's page"

KeyCode = Annotated[str, msgspec.Meta(pattern="^[A-Za-z0-9]{1,32}$")]
ActionName = Annotated[str, msgspec.Meta(pattern="^[a-z_]{1,32}$")]
Token = Annotated[str, msgspec.Meta(pattern="^[A-Za-z0-9-]{8,64}$")]
Milliseconds = Annotated[float, msgspec.Meta(ge=0.0, le=1e12)]


class _FromBrowser(msgspec.Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind"):
    """A message of the page's scripts."""


class Hello(_FromBrowser, frozen=True, tag="hello"):
    """The first message of a connection, and another one where the person gives another name or role.

    Attributes:
        seat: random, of the tab; the same after a reload and after a lost link.
        load: random, of the loaded page; the same after a lost link. Presses are numbered within it.
        name: that the person gave; empty where none was.
        role: that the person asks for; empty for the operator's.
    """

    seat: Token
    load: Token
    name: Name = ""
    role: Name = ""


class Held(_FromBrowser, frozen=True, tag="held"):
    """The full input state of a tab.

    Attributes:
        sequence: counts what the tab says, from 1.
        stamp_ms: the tab's monotonic clock [ms].
        keys: held down, by `KeyboardEvent.code`.
        visible: a person can see the tab.
        focused: it has the focus as well.
        controllers: what else is read in the browser.
        drawn: number of the newest moment that was drawn in the live view, of the newest point cloud, and of the newest
            picture of each camera.
        cloud: the live view shows the point cloud.
        jpeg_only: the browser draws no H.264.
        yaw: by which the person's forward is turned to the left from the robot's, as far as the keys are to follow the
            view [rad].
        waited_ms: how long what changed it has waited in the browser [ms].
        way_ms: how long what the tab says is under way to here, as its round trips tell [ms]; None before the first.
        picture_ms: age of the newest camera picture when it had been drawn [ms]; None before the first.
    """

    sequence: Count
    stamp_ms: Milliseconds
    keys: Annotated[tuple[KeyCode, ...], msgspec.Meta(max_length=32)]
    visible: bool
    focused: bool
    controllers: Annotated[tuple[Controller, ...], msgspec.Meta(max_length=4)]
    drawn: Annotated[tuple[Count, ...], msgspec.Meta(max_length=255)]
    cloud: bool = False
    jpeg_only: bool = False
    yaw: Yaw = 0.0
    waited_ms: Milliseconds = 0.0
    way_ms: Milliseconds | None = None
    picture_ms: Milliseconds | None = None


class Pressed(_FromBrowser, frozen=True, tag="pressed"):
    """A button was pressed. Said again until it is acknowledged, so that its number may come several times.

    Attributes:
        sequence: counts what the tab says.
        stamp_ms: of the press, by the tab's monotonic clock [ms].
        number: of the press, within the loaded page.
        action: the button's name.
        argument: what it is about; empty where the button says it all.
    """

    sequence: Count
    stamp_ms: Milliseconds
    number: Count
    action: ActionName
    argument: Reason = ""


_DECODER: msgspec.json.Decoder[Hello | Held | Pressed] = msgspec.json.Decoder(Hello | Held | Pressed)


def read(payload: str | bytes) -> Hello | Held | Pressed:
    """The message in a WebSocket frame.

    Raises:
        OversizedMessage: before anything is decoded.
        MalformedMessage: it is none of the page's messages.
    """
    if len(payload) > MAX_BYTES:
        raise OversizedMessage(_SUBJECT, len(payload), MAX_BYTES)
    try:
        return _DECODER.decode(payload)
    except (msgspec.DecodeError, RecursionError, UnicodeError) as error:
        raise MalformedMessage(_SUBJECT, str(error)) from None
