"""What comes from the browser: whose tab commands, what is held there, and which buttons were pressed.

A browser says its FULL input state 50 times a second. Keys count only from the tab that has the seat, only while it has
the focus, and only while its samples keep coming, see `Grip`.
"""

from __future__ import annotations

import logging
import threading
from collections import deque

import msgspec

from protocol.exceptions import ProtocolError
from protocol.messages import SHORTEST_REASON, Attendance, OperatorInput, Person, Role, TakeOver
from services.accounts.account import Account
from services.process.lines import one_line
from services.station.page.grip import Grip
from services.station.page.identity import SOMEBODY, identify
from services.station.page.presses import Presses
from services.station.page.said import Held, Hello, Pressed, read
from services.station.page.seat import Seat
from services.station.page.standing import Standing
from services.station.page.tab import Tab
from services.station.press import REVOKE, STOP, STOPS, Press

HEARD_NS = 1_000_000_000
"""Silence after which nobody is present at a tab."""

BEATS = 3
"""So many samples within `HEARD_NS` are a page that is alive; of one that is not seen, browsers let one through."""

SETTLED_NS = 1_000_000_000
"""Nobody is present at a tab that has just sat down: opening a page, or a link that comes back, resumes nothing."""

TAKE, SEIZE, GIVE, KEEP = "take_input", "seize_input", "give_input", "keep_input"
"""Asking for the seat, taking it at once, and answering who asks for it."""

log = logging.getLogger(__name__)


class Desk:
    """The operator's desk: several tabs may look on, one commands. Safe to use from several threads.

    Args:
        operator: name of an operator who gives none.

    Attributes:
        call: set where keys are pressed or let go, and buttons pressed: what should act at once.
    """

    def __init__(self, operator: str = "") -> None:
        self._operator = operator
        self.call = threading.Event()
        self.dropped = 0
        self.late = 0
        self._lock = threading.Lock()
        self._tabs: dict[int, Tab] = {}
        self._seat = Seat()
        self._grip = Grip()
        self._sat_ns = 0
        self._beats: deque[int] = deque(maxlen=BEATS)
        self._presses = Presses()
        self._stop_pressed = False
        self._taken: TakeOver | None = None
        self._lost = ""

    def leave(self, tab: int, now_ns: int) -> None:
        """A tab has gone; nobody inherits its seat."""
        with self._lock:
            self._tabs.pop(tab, None)
            if self._seat.leave(tab, now_ns):
                self._rise(now_ns)

    def dismiss(self, tab: int, now_ns: int) -> None:
        """Whoever was at a tab may no more: what is held there counts at once as let go, and its seat is free."""
        with self._lock:
            self._tabs.pop(tab, None)
            if self._seat.get_up(tab):
                self._sit(now_ns)

    def receive(
        self, tab: int, payload: str | bytes, now_ns: int, account: Account | None = None
    ) -> Hello | Held | Pressed | None:
        """Read and keep a message; None, and counted, where it was none.

        Args:
            tab: that says it.
            payload: as it came.
            now_ns: when.
            account: of whoever is there; None where nobody has to log in.
        """
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
                    self._enter(tab, message, now_ns, account)
                case Held():
                    self._hold(tab, message, now_ns)
                case Pressed():
                    self._press(tab, message, now_ns, account)
        return message

    def take_input(self, now_ns: int) -> OperatorInput:
        """The input as it counts now; focused only where keys would count."""
        with self._lock:
            self._expire(now_ns)
            return self._grip.input(self._name(self._seat.tab), present=self._is_present(now_ns))

    def attendance(self) -> Attendance:
        """Who is there, a tab each, and who took the input over last; the station's name aside."""
        with self._lock:
            people = tuple(
                Person(known.identity.name, known.identity.role, has_input=tab == self._seat.tab)
                for tab, known in sorted(self._tabs.items())
            )
            return Attendance(holder="", people=people, taken=self._taken)

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
            held = self._grip.held if armed else None
            question = self._seat.question
            left_s = self._seat.left_ns(now_ns) / 1e9
            known = self._tabs.get(tab)
            settled = self._presses.settled(known.hello.load if known is not None else "")
            return Standing(
                armed=armed,
                vacant=self._seat.tab is None,
                let_go=self._grip.let_go,
                heard=held is not None,
                focused=held is not None and held.focused,
                asked_s=left_s if armed else 0.0,
                asking_s=left_s if question is not None and question.tab == tab else 0.0,
                kept=tab == self._seat.kept_from,
                stop_pressed=self._stop_pressed,
                accepted=settled[True],
                refused=settled[False],
                identity=known.identity if known is not None else SOMEBODY,
                asked_by=self._name(question.tab) if armed and question is not None else "",
                lost=self._taken if known is not None and known.hello.seat == self._lost and not armed else None,
            )

    def _enter(self, tab: int, message: Hello, now_ns: int, account: Account | None) -> None:
        identity = identify(message.name, message.role, self._operator, account)
        if account is not None:  # who logs in at somebody else's tab does not find that one's seat
            message = msgspec.structs.replace(message, seat=f"{account.name}/{message.seat}")
        self._tabs[tab] = Tab(message, identity)
        if identity.role is not Role.OPERATOR:
            if self._seat.get_up(tab):
                self._sit(now_ns)
        elif self._seat.enter(tab, message.seat):
            self._sit(now_ns)

    def _name(self, tab: int | None) -> str:
        known = self._tabs.get(tab) if tab is not None else None
        return known.identity.name if known is not None else ""

    def _sit(self, now_ns: int) -> None:
        self._rise(now_ns)
        self._sat_ns = now_ns

    def _rise(self, now_ns: int) -> None:
        self._grip.sit(now_ns)
        self._beats.clear()

    def _expire(self, now_ns: int) -> None:
        self._grip.expire(now_ns)
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
        captured_ns = known.captured_ns(message, now_ns) if known is not None else 0
        if self._grip.hear(message, captured_ns, now_ns):
            self.call.set()
        if message.visible:
            self._beats.append(now_ns)
        else:
            self._beats.clear()

    def _press(self, tab: int, message: Pressed, now_ns: int, account: Account | None) -> None:
        known = self._tabs.get(tab)
        if known is not None and not self._presses.is_new(known.hello.load, message.number):
            return
        accepted = self._pass_on(tab, known, message, now_ns, account)
        if known is not None:
            self._presses.settle(known.hello.load, message.number, accepted)

    def _pass_on(self, tab: int, known: Tab | None, message: Pressed, now_ns: int, account: Account | None) -> bool:
        """Whether the press counts: a stop does at any time, from any tab, before it has said who it is as well."""
        if message.action in STOPS:
            self._stop_pressed |= message.action == STOP
            self.call.set()
            by = known.identity.name if known is not None else account.name if account is not None else ""
            return self._presses.add(Press(message.action, message.argument, by))
        if known is None or not known.has_sent_in_time(message, now_ns):
            self.late += 1
            return False
        press = Press(message.action, message.argument, known.identity.name)
        match known.identity.role:
            case Role.OPERATOR if press.action == TAKE:
                if self._seat.ask(tab, known.hello.seat, now_ns):
                    self._sit(now_ns)
                return True
            case Role.OPERATOR if press.action == SEIZE:
                return self._seize(tab, known, press, now_ns)
            case Role.SUPERVISOR if press.action == REVOKE and press.by:
                self.call.set()
                return self._presses.add(press)
            case _:
                return self._command(tab, press, now_ns)

    def _seize(self, tab: int, known: Tab, press: Press, now_ns: int) -> bool:
        """Take the input at once, and say why; whether the reason says anything."""
        why = press.argument.strip()
        if len(why) < SHORTEST_REASON:
            return False
        before, token = self._name(self._seat.tab), self._seat.token
        if self._seat.take(tab, known.hello.seat):
            self._sit(now_ns)
            self._taken, self._lost = TakeOver(press.by, before, why), token
            log.warning("%s", one_line(f"{before or 'nobody'}'s input was taken over by {press.by}: {why}"))
        return True

    def _command(self, tab: int, press: Press, now_ns: int) -> bool:
        """What only the tab may that has the seat."""
        if tab != self._seat.tab or press.action == REVOKE:
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
