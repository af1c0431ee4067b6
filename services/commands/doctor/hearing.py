"""What is heard on a network in a while: who is there, and the samples of one robot."""

from __future__ import annotations

from dataclasses import dataclass

from protocol.codec import decode
from protocol.exceptions import ProtocolError, WrongVersion
from protocol.messages import Heartbeat, RobotState
from protocol.topic import VERSION
from protocol.topics import HEARTBEAT, ROBOT_STATE
from services.bus.zenoh import Passing, Session, watch
from services.process.clock import Clock, utc_ms

LISTEN_S = 3.0 / HEARTBEAT.rate_hz
"""Three heartbeats of each process."""

OTHER_VERSIONS = tuple(version for number in range(10) if (version := f"@v{number}") != VERSION)
"""No wildcard reaches behind a version: each is asked for by its name."""

_MOST = 4096
"""Samples that are kept."""


@dataclass(frozen=True)
class Beat:
    """A heartbeat.

    Attributes:
        robot: whose network it came on.
        message: what the process says.
        received_utc_ms: the time of day here when it came [ms].
    """

    robot: str
    message: Heartbeat
    received_utc_ms: int


@dataclass(frozen=True)
class Foreign:
    """A heartbeat of another version of the protocol.

    Attributes:
        robot: whose network it came on.
        process: that sent it.
        speaks: its version.
    """

    robot: str
    process: str
    speaks: str


@dataclass(frozen=True)
class Sample:
    """When a sample of the robot's was stamped by its clock, and when it came by this one [ns]."""

    publisher: int
    stamp_ns: int
    received_ns: int


class Hearing:
    """All that was heard. What comes is kept on the network's threads."""

    def __init__(self) -> None:
        self.foreign: set[Foreign] = set()
        self.samples: list[Sample] = []
        self._beats: dict[tuple[str, str], Beat] = {}

    def listen(self, session: Session, robot: str, clock: Clock) -> None:
        """Listen from now on, to everybody's heartbeats and to one robot's samples."""
        for version in (VERSION, *OTHER_VERSIONS):
            watch(session, f"retouch/{version}/*/{HEARTBEAT.name}/*", self.beat)
        watch(session, ROBOT_STATE.key(robot, "*"), lambda passing: self.sample(passing, clock.now_ns()))

    def beat(self, passing: Passing) -> None:
        """Keep a heartbeat; what is none is passed over."""
        _, version, robot, _, _, process = passing.key.split("/")
        if version != VERSION:
            self._note(Foreign(robot, process, version))
            return
        try:
            message = decode(HEARTBEAT, passing.payload, passing.schema)
        except WrongVersion:
            self._note(Foreign(robot, process, passing.schema))
        except ProtocolError:
            return
        else:
            if len(self._beats) < _MOST or (robot, process) in self._beats:
                self._beats[robot, process] = Beat(robot, message, utc_ms())

    def sample(self, passing: Passing, received_ns: int) -> None:
        """Keep when a sample of the robot's came; what is none is passed over."""
        try:
            state: RobotState = decode(ROBOT_STATE, passing.payload, passing.schema)
        except ProtocolError:
            return
        if len(self.samples) < _MOST:
            self.samples.append(Sample(state.publisher, state.stamp_ns, received_ns))

    def _note(self, foreign: Foreign) -> None:
        if len(self.foreign) < _MOST:
            self.foreign.add(foreign)

    @property
    def robots(self) -> dict[str, dict[str, Beat]]:
        """The processes that were heard, by their names, of each robot, by its name."""
        robots: dict[str, dict[str, Beat]] = {}
        for (robot, process), beat in sorted(self._beats.copy().items()):
            robots.setdefault(robot, {})[process] = beat
        return robots
