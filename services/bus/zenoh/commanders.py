"""Which robots there are and who commands each: tokens on the network, told where they change, not ten times a second.

A robot's process has one token, whose key names its operator. Whoever looks is told of all of them at once, and of each
change, however many robots there are.
"""

from __future__ import annotations

import contextlib
import logging
import threading
from collections.abc import Mapping

import zenoh

from protocol.commander import EVERYBODY, commander_key, told
from protocol.exceptions import InvalidName
from services.bus.zenoh.session import Session

log = logging.getLogger(__name__)

ROBOTS_KEPT = 1024
"""So many robots of one network are told apart."""

TOKENS_KEPT = 4
"""Of one robot; its own process has two for a moment, while one takes the other's place."""


class CommanderToken(threading.Thread):
    """A robot's token. A daemon of its own, since declaring may wait for a link, for which no control waits.

    Args:
        session: to declare it on, and on every one that takes its place.
        robot: whose it is.
    """

    def __init__(self, session: Session, robot: str) -> None:
        super().__init__(name="commander-token", daemon=True)
        self._session = session
        self._robot = robot
        self._key = commander_key(robot, "")
        self._changed = threading.Event()
        self._ended = False
        self._exchange = threading.Lock()
        self._on: zenoh.Session
        self._token: zenoh.LivelinessToken

    def tell(self, operator: str) -> None:
        """Say who commands; empty for nobody. It returns at once."""
        key = commander_key(self._robot, operator)
        if key != self._key:
            self._key = key
            self._changed.set()

    def run(self) -> None:
        """Declare it, and another one where who commands has changed."""
        try:
            self._session.declare(self._declared)
            while not self._ended:
                self._changed.wait()
                self._changed.clear()
                self._replace()
        except zenoh.ZError as error:
            log.debug("who commands is told no more: %s", error)

    def end(self) -> None:
        """Tell no more."""
        self._ended = True
        self._changed.set()

    def _declared(self, session: zenoh.Session) -> CommanderToken:
        with self._exchange:
            self._on, self._token = session, session.liveliness().declare_token(self._key)
        return self

    def _replace(self) -> None:
        with self._exchange, contextlib.suppress(zenoh.ZError):  # that session has ended: the next one has it as it is
            # The new one first: the robot is never away.
            before, self._token = self._token, self._on.liveliness().declare_token(self._key)
            before.undeclare()  # type: ignore[no-untyped-call]  # Zenoh's stub leaves it bare


class Commanders:
    """What all robots' tokens say.

    Args:
        session: to look on.
    """

    def __init__(self, session: Session) -> None:
        self._there: dict[str, set[str]] = {}
        self._last: dict[str, str] = {}
        self._exchange = threading.Lock()
        session.declare(lambda now: now.liveliness().declare_subscriber(EVERYBODY, self._hear, history=True))

    def now(self) -> Mapping[str, str]:
        """Who commands each robot, as was last told of it; empty for nobody. One that has gone is not forgotten."""
        with self._exchange:
            return dict(self._last)

    def _hear(self, sample: zenoh.Sample) -> None:
        with contextlib.suppress(InvalidName):
            robot, operator = told(str(sample.key_expr))
            with self._exchange:
                self._note(robot, operator, there=sample.kind == zenoh.SampleKind.PUT)

    def _note(self, robot: str, operator: str, *, there: bool) -> None:
        """Take note; bounded, since a stranger may invent more."""
        if robot not in self._last and len(self._last) >= ROBOTS_KEPT:
            return
        present = self._there.setdefault(robot, set())
        if not there:
            present.discard(operator)
        elif len(present) < TOKENS_KEPT:
            present.add(operator)
            self._last[robot] = operator
        if present and self._last[robot] not in present:
            self._last[robot] = min(present)
