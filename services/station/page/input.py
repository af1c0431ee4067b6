"""What comes from the browser: whose tab commands, what is held there, and which buttons were pressed.

A browser says its FULL input state 50 times a second. Keys count only from one tab, only while it has the focus, and
only while its samples keep coming; after any interruption they count again once everything has been let go.
"""

from __future__ import annotations

import threading
from dataclasses import dataclass
from typing import Annotated

import msgspec

from protocol.exceptions import MalformedMessage, OversizedMessage, ProtocolError
from protocol.messages import Count, OperatorInput
from services.bus.freshness import Freshness, Judgement

DEAD_MAN_NS = 150_000_000
"""Age at which the input state counts as zero."""

ABANDONED_NS = 1_000_000_000
"""Silence after which another tab that opens takes the input."""

MAX_BYTES = 4_096
ACTIONS_KEPT = 64
STOP = "stop"

_SUBJECT = "the operator's page"
_OWN_CLOCK = 1 << 47
"""An identity on another machine than any tab's number, since a browser's clock is not comparable."""

KeyCode = Annotated[str, msgspec.Meta(pattern="^[A-Za-z0-9]{1,32}$")]
ActionName = Annotated[str, msgspec.Meta(pattern="^[a-z_]{1,32}$")]
Axis = Annotated[float, msgspec.Meta(ge=-1.0, le=1.0)]


class _FromBrowser(msgspec.Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind"):
    """A message of the page's scripts."""


class Held(_FromBrowser, frozen=True, tag="held"):
    """The full input state of a tab.

    Attributes:
        sequence: counts the tab's samples, from 1.
        stamp_ms: the tab's monotonic clock [ms].
        keys: held down, by `KeyboardEvent.code`.
        focused: the tab is visible and has the focus.
        axes: of the gamepad.
        drawn: number of the newest picture that was drawn, by camera.
    """

    sequence: Count
    stamp_ms: Annotated[float, msgspec.Meta(ge=0.0, le=1e12)]
    keys: Annotated[tuple[KeyCode, ...], msgspec.Meta(max_length=32)]
    focused: bool
    axes: Annotated[tuple[Axis, ...], msgspec.Meta(max_length=16)]
    drawn: tuple[Count, Count]

    @property
    def neutral(self) -> bool:
        """Nothing is held or deflected."""
        return not self.keys and not any(self.axes)


class Pressed(_FromBrowser, frozen=True, tag="pressed"):
    """A button was pressed."""

    action: ActionName


class TakeInput(_FromBrowser, frozen=True, tag="take_input"):
    """This tab wants to be the one that commands."""


_DECODER: msgspec.json.Decoder[Held | Pressed | TakeInput] = msgspec.json.Decoder(Held | Pressed | TakeInput)


def read(payload: str | bytes) -> Held | Pressed | TakeInput:
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


@dataclass(frozen=True)
class Standing:
    """How a tab stands: whether its input counts, and whether everything has to be let go first."""

    armed: bool
    let_go: bool


class Desk:
    """The operator's desk: several tabs may look on, one commands. Safe to use from several threads."""

    def __init__(self) -> None:
        self.dropped = 0
        self.late = 0
        self._lock = threading.Lock()
        self._tab: int | None = None
        self._freshness = Freshness(DEAD_MAN_NS, _OWN_CLOCK)
        self._held: Held | None = None
        self._heard_ns = 0
        self._let_go = True
        self._actions: list[str] = []

    def join(self, tab: int, now_ns: int) -> None:
        """A tab opened; it commands where no other does."""
        with self._lock:
            if self._tab is None or now_ns - self._heard_ns > ABANDONED_NS:
                self._arm(tab, now_ns)

    def leave(self, tab: int) -> None:
        """A tab closed; nobody inherits its input."""
        with self._lock:
            if tab == self._tab:
                self._tab = None
                self._silence()

    def receive(self, tab: int, payload: str | bytes, now_ns: int) -> Held | Pressed | TakeInput | None:
        """Read and keep a message; None, and counted, where it was none."""
        try:
            message = read(payload)
        except ProtocolError:
            with self._lock:
                self.dropped += 1
            return None
        with self._lock:
            match message:
                case Held():
                    self._hold(tab, message, now_ns)
                case Pressed():
                    self._press(tab, message.action)
                case TakeInput():
                    self._arm(tab, now_ns)
        return message

    def take_input(self, now_ns: int) -> OperatorInput:
        """The input as it counts now."""
        with self._lock:
            self._expire(now_ns)
            held = self._held
            if held is None:
                return OperatorInput()
            if self._let_go or not held.focused:
                return OperatorInput(focused=held.focused)
            return OperatorInput(keys=held.keys, focused=True, axes=held.axes)

    def take_actions(self) -> list[str]:
        """The buttons pressed since the last call, in order."""
        with self._lock:
            taken, self._actions = self._actions, []
        return taken

    def standing(self, tab: int, now_ns: int) -> Standing:
        """How the tab stands now."""
        with self._lock:
            self._expire(now_ns)
            return Standing(tab == self._tab, self._let_go)

    def _arm(self, tab: int, now_ns: int) -> None:
        self._tab = tab
        self._heard_ns = now_ns
        self._freshness = Freshness(DEAD_MAN_NS, _OWN_CLOCK)
        self._silence()

    def _silence(self) -> None:
        self._held = None
        self._let_go = True

    def _expire(self, now_ns: int) -> None:
        if now_ns - self._heard_ns > DEAD_MAN_NS:
            self._silence()

    def _hold(self, tab: int, message: Held, now_ns: int) -> None:
        if tab != self._tab:
            return
        self._expire(now_ns)
        stamp_ns = round(message.stamp_ms * 1e6)
        if self._freshness.judge(tab, message.sequence, stamp_ns, now_ns) is not Judgement.FRESH:
            self.late += 1
            return
        self._held = message
        self._heard_ns = now_ns
        if not message.focused:
            self._let_go = True
        elif message.neutral:
            self._let_go = False

    def _press(self, tab: int, action: str) -> None:
        """A tab that only looks on may stop the robot, nothing else; a stop is never one too many."""
        if action == STOP or (tab == self._tab and len(self._actions) < ACTIONS_KEPT):
            if action != STOP or STOP not in self._actions:
                self._actions.append(action)
        else:
            self.dropped += 1
