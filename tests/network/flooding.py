"""A program that floods a robot at a steady rate: `flooding.py KIND ROBOT HERE ELSEWHERE [FOLDER NAME]`.

It sends the same to a router where nobody listens, so that what it takes of the processor is the same: a line on
standard input says where to, `here` or `elsewhere`. Standard output tells how much was sent there until the next one.
"""

import itertools
import sys
import threading
import time
from functools import partial
from pathlib import Path

import zenoh

from protocol import queries, topics
from protocol.codec import encode_request
from protocol.messages import AuthorityRenewal, AuthorityRequest, EmergencyStop, MasterState
from protocol.names import process_name
from protocol.rights import subject
from services.bus.identity import new_publisher
from services.bus.outbox import Outbox
from services.bus.zenoh import open_session
from services.bus.zenoh.encoding import encoding
from services.certificates.credentials import Credentials
from services.process.clock import SystemClock
from tests.cameras import HEAD_IMAGE

RATES = {"messages": 10_000.0, "pictures": 100.0, "queries": 1_000.0}
"""Of each kind, a second."""

AT_ONCE = {"messages": 1, "pictures": 1, "queries": 1_000}
"""So many of them together."""

PAUSE_S = 0.002
BEHIND_S = 0.1
"""What could not be sent for so long is not made up for."""

MEGABYTE = b"\0" * 1_000_000
SAID = (
    (topics.MASTER_STATE, "master", MasterState(holder="flood", epoch=1)),
    (topics.AUTHORITY_RENEWAL, "station", AuthorityRenewal(holder="flood", epoch=1)),
    (topics.AUTHORITY_REQUEST, "station", AuthorityRequest(holder="flood", number=0)),
    (topics.EMERGENCY_STOP, "station", EmergencyStop(pressed=False, by="flood")),
)
"""What the robot reads, and which process says it."""

ASKED = (
    (queries.ACQUIRE, encode_request(queries.ACQUIRE, queries.AcquireAuthority("flood", "flood"))),
    (queries.FINISH, encode_request(queries.FINISH, queries.Finish(1))),
    (queries.RESET, encode_request(queries.RESET, queries.Reset(1))),
    (queries.REVOKE, b"no request"),
    (queries.PREDICT, b"\0" * queries.PREDICT.max_bytes),
)
"""What is asked, sound or not."""


class Flood:
    """Sends one kind of thing, again and again.

    Args:
        robot: to whom.
        whose: name of the certificate that is shown; empty for none.
    """

    def __init__(self, robot, whose):
        self._robot = robot
        self._whose = subject(whose) if whose else None
        self._clock = SystemClock()
        named = self._named if self._whose is None or self._whose.kind.person else str  # a robot's forges others' words
        self._outboxes = {role: Outbox(new_publisher(), robot, named(role)) for role in ("master", "station")}

    def _named(self, role):
        """A process of the role: of the person, or of one who has no name."""
        if self._whose is None:
            return role
        return process_name(role, self._whose.name) if self._whose.kind.person else self._whose.kind.name

    def messages(self):
        """Sound ones, numbered and stamped, on whatever the robot reads."""
        for topic, role, message in itertools.cycle(SAID):
            yield partial(self._say, topic, role, message)

    def pictures(self):
        """As large as pictures may be, where they belong and where they do not."""
        places = ((HEAD_IMAGE, "camera"), (topics.MASTER_STATE, "master"), (topics.EMERGENCY_STOP, "station"))
        for topic, role in itertools.cycle(places):
            key = topic.key(self._robot, self._named(role))
            yield partial(zenoh.Session.put, key_expr=key, payload=MEGABYTE)

    def queries(self):
        """To the robot and its model, whose answers nobody waits for."""
        for query, payload in itertools.cycle(ASKED):
            yield partial(self._ask, query, payload)

    def _say(self, topic, role, message, session):
        payload = self._outboxes[role].pack(topic, message, self._clock.now_ns())
        session.put(topic.key(self._robot, self._named(role)), payload, encoding=encoding(topic.schema))

    def _ask(self, query, payload, session):
        session.get(
            query.key(self._robot, self._named("station")),
            zenoh.handlers.Callback(lambda reply: None),
            payload=payload,
            encoding=encoding(query.schema),
            timeout=2.0,
        )


class Place:
    """Where to, as standard input says."""

    def __init__(self):
        self.now = "elsewhere"
        self.ended = threading.Event()

    def follow(self):
        """Until there is nothing more to read."""
        for line in sys.stdin:
            self.now = line.strip()
        self.ended.set()


def main(kind, robot, here, elsewhere, *shown):
    """Flood until standard input ends."""
    folder, whose = shown or ("", "")
    credentials = Credentials(Path(folder), subject(whose)) if whose else None
    sessions = {
        name: open_session(endpoint, 30.0, credentials=credentials)
        for name, endpoint in (("here", here), ("elsewhere", elsewhere))
    }
    place, sent = Place(), dict.fromkeys(sessions, 0)
    threading.Thread(target=place.follow, daemon=True).start()
    told, rate = place.now, RATES[kind]
    flow = getattr(Flood(robot, whose), kind)()
    print("flooding", flush=True)
    due = time.monotonic()
    while not place.ended.wait(PAUSE_S):
        if place.now != told:
            print(sent[told], flush=True)
            told, sent[told] = place.now, 0
        now = time.monotonic()
        due = max(due, now - BEHIND_S)
        while due < now:
            for send in itertools.islice(flow, AT_ONCE[kind]):
                send(sessions[told].current)
            sent[told] += AT_ONCE[kind]
            due += AT_ONCE[kind] / rate
    for session in sessions.values():
        session.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
