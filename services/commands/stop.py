"""`retouch stop`: the emergency stop from the command line, and what a supervisor does without a page."""

from __future__ import annotations

import logging
import os
import time
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from protocol import topics
from protocol.messages import LONGEST_REASON, SHORTEST_REASON
from services.bus.zenoh import Lanes, ZenohBus, open_session
from services.certificates.credentials import TOOL, credentials
from services.commands.arguments import add_network, within
from services.commands.pressing import Press, PressAll, Release, Revoke, story
from services.commands.settings import configuration as configured
from services.process.clock import SystemClock
from services.process.config import Configuration
from services.process.ending import end_within
from services.process.exceptions import CommandFailed, NotConfirmed, RouterUnreachable
from services.process.lines import one_line
from services.process.runner import stop_on_signals

log = logging.getLogger(__name__)

REPEAT_S = 1.0 / topics.EMERGENCY_STOP.rate_hz
TELL_S = 1.0
TIMEOUT_S = 30.0

_ABOUT = """\
Presses the robot's emergency stop until the robot says that it has latched and that
it stands; through an outage of the network too. Ends with 3, and says so, where the
robot did not: then use its own emergency stop.
"""


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = _ABOUT
    add_network(parser)
    instead = parser.add_mutually_exclusive_group()
    instead.add_argument("--all", action="store_true", help="every robot on the network; names who did not stop")
    instead.add_argument("--release", action="store_true", help="release the stop instead")
    instead.add_argument(
        "--revoke",
        metavar="WHY",
        help="end the authority of whoever commands instead; they are told why, the robot holds",
    )
    parser.add_argument(
        "--timeout",
        type=within(0.0, 3600.0, "seconds", above=True),
        metavar="S",
        default=TIMEOUT_S,
        help=f"give up after so many seconds (default: {TIMEOUT_S:g})",
    )


def run(arguments: Namespace) -> int:
    """See `Action`."""
    if arguments.revoke is not None:
        revoke(configured(arguments), arguments.revoke, arguments.timeout)
    elif arguments.all:
        stop_all(configured(arguments), arguments.timeout)
    else:
        (release if arguments.release else stop)(configured(arguments), arguments.timeout)
    return 0


def stop(configuration: Configuration, timeout_s: float = TIMEOUT_S) -> None:
    """Press until the robot says that it has latched and stands.

    Raises:
        BadEndpoint: there can be no such network.
        NotConfirmed: the robot did not say so in time.
        KeyboardInterrupt: somebody ended it before.
    """
    attempt = _Attempt("stop", _named(configuration), timeout_s, "use its own emergency stop")
    with attempt.bus(configuration) as bus:
        attempt.until(Press(bus, configuration.operator).step)
    log.info("%s has stopped and stands", _named(configuration))


def stop_all(configuration: Configuration, timeout_s: float = TIMEOUT_S) -> None:
    """Press every robot's until all that are heard say that they have latched and stand; raises as `stop`."""
    attempt = _Attempt("stop", "all robots", timeout_s, "use the emergency stop of those that are named")
    with attempt.bus(configuration) as bus:
        press = PressAll(bus, configuration.name, configuration.operator)
        attempt.until(press.step)
    log.info("all robots that are heard have stopped and stand: %s", ", ".join(sorted(press.stopped)))


def release(configuration: Configuration, timeout_s: float = TIMEOUT_S) -> None:
    """Release the latched stop; whoever wants to move the robot has to ask for the authority again.

    Raises:
        BadEndpoint: there can be no such network.
        CommandFailed: the robot refused.
        NotConfirmed: nobody answered in time.
        KeyboardInterrupt: somebody ended it before.
    """
    remedy = "what is stopped stays so; release it again once the robot can be reached"
    attempt = _Attempt("release", _named(configuration), timeout_s, remedy)
    with attempt.bus(configuration) as bus:
        released = Release(bus, configuration.operator)
        attempt.until(released.step)
    assert released.was is not None
    log.info("robot %s is released by %s; %s", configuration.name, configuration.operator, story(released.was))


def revoke(configuration: Configuration, reason: str, timeout_s: float = TIMEOUT_S) -> None:
    """End the authority of whoever commands; the robot holds until somebody asks for it.

    Raises:
        BadEndpoint: there can be no such network.
        CommandFailed: the robot refused.
        NotConfirmed: nobody answered in time.
        KeyboardInterrupt: somebody ended it before.
    """
    if not SHORTEST_REASON <= len(reason.strip()) <= LONGEST_REASON:
        raise CommandFailed(f"--revoke: give a reason of {SHORTEST_REASON} to {LONGEST_REASON} characters")
    remedy = "stop the robot with 'retouch stop'"
    attempt = _Attempt("revocation", _named(configuration), timeout_s, remedy)
    with attempt.bus(configuration, revokes=True) as bus:
        revoked = Revoke(bus, configuration.operator, reason.strip())
        attempt.until(revoked.step)
    assert revoked.was is not None
    who = one_line(revoked.was.operator or revoked.was.holder)
    log.info(
        "nobody commands robot %s any more: %s revoked %s's authority", configuration.name, configuration.operator, who
    )


def _named(configuration: Configuration) -> str:
    return f"robot {configuration.name}"


class _Attempt:
    """Something that goes on until the robot confirms it.

    Args:
        what: is to be confirmed.
        whom: who has to confirm it.
        timeout_s: gives up after it [s].
        remedy: what to do where nothing confirmed it.
    """

    def __init__(self, what: str, whom: str, timeout_s: float, remedy: str) -> None:
        self._what = what
        self._whom = whom
        self._timeout_s = timeout_s
        self._remedy = remedy
        self._began = time.monotonic()
        self._interrupted = stop_on_signals()
        end_within()

    @contextmanager
    def bus(self, configuration: Configuration, *, revokes: bool = False) -> Iterator[ZenohBus]:
        """The way to the robot, once there is one; dialled until then."""
        shown = credentials(configuration, configuration.connect, revokes=revokes)
        try:
            session = open_session(configuration.connect, self._timeout_s, self._interrupted, self._tell, shown)
        except RouterUnreachable as error:
            reason = f"no router at {error.endpoint}: {error.reason}"
            raise NotConfirmed(self._what, self._whom, self._timeout_s, reason, self._remedy) from None
        name = shown.process(TOOL) if shown is not None else f"{TOOL}-{os.getpid()}"
        bus = ZenohBus(Lanes(session), configuration.name, name, SystemClock())
        try:
            yield bus
        finally:
            bus.close()

    def until(self, step: Callable[[int], str]) -> None:
        """Step until nothing is waited for any more."""
        clock, told = SystemClock(), self._began
        while waits_for := step(clock.now_ns()):
            now = time.monotonic()
            if now - self._began > self._timeout_s:
                raise NotConfirmed(self._what, self._whom, self._timeout_s, waits_for, self._remedy)
            if now - told > TELL_S:
                told = now
                self._tell(waits_for)
            if self._interrupted.wait(REPEAT_S):
                log.error("interrupted; %s of %s was NOT confirmed: %s", self._what, self._whom, waits_for)
                raise KeyboardInterrupt

    def _tell(self, waits_for: str) -> None:
        log.warning("%s of %s NOT confirmed yet: %s", self._what, self._whom, waits_for)
