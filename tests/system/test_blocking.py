"""A link that is full because its router hangs lets nobody wait: publishing, asking and subscribing return at once."""

import time

import pytest
import zenoh

from protocol import queries, topics
from protocol.messages import AuthorityState, SafetyState
from services.bus.zenoh import connect, open_session, watch
from services.process.clock import SystemClock
from tests.system.harness import START_S, eventually
from tests.system.test_ending import Router

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.alone]

HANGS_S = 3.0
AT_ONCE_S = 1.0
"""A transport that waits for room waits for five seconds."""

PERIOD_S = 0.005
LOAD = b"x" * 60_000


def slowest(calls, duration_s):
    """The longest that any of the calls took, made in turn for so long [s]."""
    worst, deadline = 0.0, time.monotonic() + duration_s
    while time.monotonic() < deadline:
        for call in calls:
            began = time.monotonic()
            call()
            worst = max(worst, time.monotonic() - began)
        time.sleep(PERIOD_S)
    return worst


def test_nobody_waits_for_a_full_link(tmp_path):
    with Router(tmp_path) as router:
        bus = connect(router.endpoint, "robot1", "robot", SystemClock())
        loader = open_session(router.endpoint, START_S)
        hearer = open_session(router.endpoint, START_S)
        heard = []
        watch(hearer, "load", heard.append)
        publisher = loader.current.declare_publisher("load", congestion_control=zenoh.CongestionControl.DROP)
        eventually(lambda: publisher.put(LOAD) or heard, START_S, "the load is heard")
        bus.publish(topics.SAFETY_STATE, SafetyState(emergency_stop=False))
        router.hang()
        calls = [
            lambda: publisher.put(LOAD),
            lambda: bus.publish(topics.SAFETY_STATE, SafetyState(emergency_stop=False)),
            lambda: bus.publish(topics.AUTHORITY_STATE, AuthorityState(holder="", epoch=0, expires_in=0.0)),
            lambda: bus.ask(queries.DESCRIBE, queries.Describe()),
            lambda: bus.subscribe(topics.MODEL_STATE),
        ]
        assert slowest(calls, HANGS_S) < AT_ONCE_S
        for session in (loader, hearer):
            session.close()
        bus.close()
