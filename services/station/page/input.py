"""What comes from the browser: whose tab commands, what is held there, and which buttons were pressed.

A browser says its FULL input state 50 times a second. Keys count only from the tab that has the seat, only while it has
the focus, and only while its samples keep coming. After any interruption nobody is at the keys until everything that
steers was let go: a held key that was not heard meanwhile must neither count nor look as if it did.
"""

from __future__ import annotations

import threading
from collections import deque
from dataclasses import dataclass

from protocol import topics
from protocol.exceptions import ProtocolError
from protocol.keys import STEERING
from protocol.messages import OperatorInput
from services.bus.freshness import Freshness, Judgement
from services.station.page.presses import Presses
from services.station.page.said import Held, Hello, Pressed, read
from services.station.page.seat import Seat
from services.station.press import STOP, Press

DEAD_MAN_NS = 150_000_000
"""Age at which the input state counts as zero."""

HEARD_NS = 1_000_000_000
"""Silence after which nobody is present at a tab."""

BEATS = 3
"""So many samples within `HEARD_NS` are a page that is alive; of one that is not seen, browsers let one through."""

SETTLED_NS = 1_000_000_000
"""Nobody is present at a tab that has just sat down: opening a page, or a link that comes back, resumes nothing."""

LATE_PRESS_NS = 1_000_000_000
"""Age at which a press is dropped: what was asked for a moment ago may be wrong by now."""

TAKE, GIVE, KEEP = "take_input", "give_input", "keep_input"

_OURS, _BROWSERS = 0, 1 << 47
"""Identities on two machines: a browser's clock is not ours."""


class _Tab:
    """A tab that said who it is.

    Each has clocks of its own, since no two browsers' compare: one by which states are late, one by which presses are.
    """

    def __init__(self, hello: Hello) -> None:
        self.hello = hello
        self._states = Freshness(DEAD_MAN_NS, _OURS, topics.OPERATOR_INPUT.rate_hz)
        self._presses = Freshness(LATE_PRESS_NS, _OURS, topics.OPERATOR_INPUT.rate_hz)

    def has_sent_in_time(self, message: Held | Pressed, now_ns: int) -> bool:
        """Whether the message is new and no older than its kind may be."""
        sample = (_BROWSERS, message.sequence, round(message.stamp_ms * 1e6), now_ns)
        of_press = self._presses.judge(*sample)
        judgement = of_press if isinstance(message, Pressed) else self._states.judge(*sample)
        return judgement is Judgement.FRESH


@dataclass(frozen=True)
class Standing:
    """How a tab stands.

    Attributes:
        armed: it has the seat: its input counts.
        let_go: it counts once everything that steers was let go.
        heard: what is held there comes, and in time.
        focused: it has the focus, as it said last.
        asked_s: somebody asks for this tab's seat, and gets it in so many seconds [s]; 0 where nobody does.
        asking_s: this tab asks for the seat and gets it in so many seconds [s]; 0 where it does not.
        kept: this tab asked for the seat, which was kept.
        stop_pressed: an emergency stop was pressed in some tab, and the robot has not confirmed it yet.
        accepted: numbers of this page's presses that were passed on.
        refused: numbers of those that were not.
    """

    armed: bool
    let_go: bool
    heard: bool
    focused: bool
    asked_s: float
    asking_s: float
    kept: bool
    stop_pressed: bool
    accepted: tuple[int, ...]
    refused: tuple[int, ...]


class Desk:
    """The operator's desk: several tabs may look on, one commands. Safe to use from several threads.

    Attributes:
        call: set where keys are pressed or let go, and buttons pressed: what should act at once.
    """

    def __init__(self) -> None:
        self.call = threading.Event()
        self.dropped = 0
        self.late = 0
        self._lock = threading.Lock()
        self._tabs: dict[int, _Tab] = {}
        self._seat = Seat()
        self._held: Held | None
        self._let_go: bool
        self._heard_ns: int
        self._sat_ns: int
        self._beats: deque[int] = deque(maxlen=BEATS)
        self._presses = Presses()
        self._stop_pressed = False
        self._sit(0)

    def leave(self, tab: int, now_ns: int) -> None:
        """A tab has gone; nobody inherits its seat."""
        with self._lock:
            self._tabs.pop(tab, None)
            if self._seat.leave(tab, now_ns):
                self._empty()

    def receive(self, tab: int, payload: str | bytes, now_ns: int) -> Hello | Held | Pressed | None:
        """Read and keep a message; None, and counted, where it was none."""
        try:
            message = read(payload)
        except ProtocolError:
            with self._lock:
                self.dropped += 1
            return None
        with self._lock:
            self._expire(now_ns)
            match message:
                case Hello():
                    self._enter(tab, message, now_ns)
                case Held():
                    self._hold(tab, message, now_ns)
                case Pressed():
                    self._press(tab, message, now_ns)
        return message

    def take_input(self, now_ns: int) -> OperatorInput:
        """The input as it counts now; focused only where keys would count."""
        with self._lock:
            self._expire(now_ns)
            present = self._is_present(now_ns)
            held = self._held
            if held is None or self._let_go:
                return OperatorInput(present=present)
            return OperatorInput(present=present, keys=held.keys, focused=True, controllers=held.controllers)

    def take_presses(self) -> list[Press]:
        """The buttons pressed since the last call, in order, a stop first."""
        with self._lock:
            return self._presses.take()

    def confirm_stop(self) -> None:
        """The robot says that it is stopped and stands."""
        with self._lock:
            self._stop_pressed = False

    def standing(self, tab: int, now_ns: int) -> Standing:
        """How the tab stands now."""
        with self._lock:
            self._expire(now_ns)
            armed = tab == self._seat.tab
            held = self._held if armed else None
            question = self._seat.question
            left_s = self._seat.left_ns(now_ns) / 1e9
            known = self._tabs.get(tab)
            settled = self._presses.settled(known.hello.load if known is not None else "")
            return Standing(
                armed=armed,
                let_go=self._let_go,
                heard=held is not None,
                focused=held is not None and held.focused,
                asked_s=left_s if armed else 0.0,
                asking_s=left_s if question is not None and question.tab == tab else 0.0,
                kept=tab == self._seat.kept_from,
                stop_pressed=self._stop_pressed,
                accepted=settled[True],
                refused=settled[False],
            )

    def _enter(self, tab: int, message: Hello, now_ns: int) -> None:
        self._tabs[tab] = _Tab(message)
        if self._seat.enter(tab, message.seat):
            self._sit(now_ns)

    def _sit(self, now_ns: int) -> None:
        self._empty()
        self._heard_ns = self._sat_ns = now_ns

    def _empty(self) -> None:
        self._silence()
        self._beats.clear()

    def _silence(self) -> None:
        self._held = None
        self._let_go = True

    def _expire(self, now_ns: int) -> None:
        if now_ns - self._heard_ns > DEAD_MAN_NS:
            self._silence()
        if self._seat.expire(now_ns):
            self._sit(now_ns)

    def _is_present(self, now_ns: int) -> bool:
        settled = now_ns - self._sat_ns >= SETTLED_NS
        return settled and len(self._beats) == BEATS and now_ns - self._beats[0] <= HEARD_NS

    def _hold(self, tab: int, message: Held, now_ns: int) -> None:
        known = self._tabs.get(tab)
        in_time = known is not None and known.has_sent_in_time(message, now_ns)
        if tab != self._seat.tab:
            return
        if not in_time:
            self.late += 1
            return
        before, self._held = self._held, message
        if before is None or before.keys != message.keys or before.focused != message.focused:
            self.call.set()
        self._heard_ns = now_ns
        if message.visible:
            self._beats.append(now_ns)
        else:
            self._beats.clear()
        if not (message.visible and message.focused):
            self._let_go = True
        elif STEERING.isdisjoint(message.keys):
            self._let_go = False

    def _press(self, tab: int, message: Pressed, now_ns: int) -> None:
        known = self._tabs.get(tab)
        if known is not None and not self._presses.is_new(known.hello.load, message.number):
            return
        accepted = self._pass_on(tab, known, message, now_ns)
        if known is not None:
            self._presses.settle(known.hello.load, message.number, accepted)

    def _pass_on(self, tab: int, known: _Tab | None, message: Pressed, now_ns: int) -> bool:
        """Whether the press counts: a stop does at any time, from any tab, before it has said who it is as well."""
        if message.action == STOP:
            self._stop_pressed = True
            self.call.set()
            return self._presses.add(Press(STOP))
        if known is None or not known.has_sent_in_time(message, now_ns):
            self.late += 1
            return False
        if message.action == TAKE:
            if self._seat.ask(tab, known.hello.seat, now_ns):
                self._sit(now_ns)
            return True
        return self._command(tab, Press(message.action, message.argument), now_ns)

    def _command(self, tab: int, press: Press, now_ns: int) -> bool:
        """What only the tab may that has the seat."""
        if tab != self._seat.tab:
            self.dropped += 1
            return False
        if press.action == KEEP:
            self._seat.keep()
        elif press.action == GIVE:
            if self._seat.give():
                self._sit(now_ns)
        else:
            self.call.set()
            return self._presses.add(press)
        return True
