"""Nobody gets in without a valid certificate, and whoever is in can do no more than it says."""

import shutil
import threading
import time

import pytest

from protocol import queries, topics
from protocol.messages import (
    AuthorityRenewal,
    AuthorityState,
    EmergencyStop,
    MasterState,
    SafetyState,
)
from protocol.rights import subject
from services.bus.bus import Failed
from services.bus.zenoh import connect, open_router, open_session, watch
from services.certificates.credentials import Credentials
from services.process.clock import SystemClock
from services.process.exceptions import RouterUnreachable
from tests.network.identities import Identities
from tests.ports import free_port
from tests.system.harness import eventually

pytestmark = pytest.mark.zenoh

ROBOT = "kitchen"
TURNED_AWAY_S = 1.5
WITHIN_S = 20.0
MOMENT_S = 0.3


@pytest.fixture
def bus(identities, endpoint):
    """Makes buses, each of a process with a certificate."""
    opened = []

    def join(name, process, robot=ROBOT):
        opened.append(connect(endpoint, robot, process, SystemClock(), credentials=identities.of(name)))
        return opened[-1]

    yield join
    for one in opened:
        one.close()


class Robot:
    """Stands in for the robot's process: what it hears, and what it is asked.

    Args:
        bus: of the robot.
    """

    def __init__(self, bus):
        self.bus = bus
        self.master = bus.subscribe(topics.MASTER_STATE)
        self.renewal = bus.subscribe(topics.AUTHORITY_RENEWAL)
        self.stop = bus.subscribe(topics.EMERGENCY_STOP)
        self.servers = [bus.serve(query) for query in queries.QUERIES if query.server == "robot"]

    def heard(self):
        """Who was heard on what changes anything."""
        return {
            (name, received.message.process)
            for name, subscription in (("master", self.master), ("renewal", self.renewal), ("stop", self.stop))
            for received in subscription.take()
        }

    def asked(self):
        """By whom it was asked for anything."""
        return {call.asker for server in self.servers for call in server.take()}


@pytest.fixture
def robot(bus):
    return Robot(bus("robot.kitchen", "robot"))


def commands(bus):
    """Try everything that commands."""
    bus.publish(topics.MASTER_STATE, MasterState(holder="x", epoch=1))
    bus.publish(topics.AUTHORITY_RENEWAL, AuthorityRenewal(holder="x", epoch=1))


def turned_away(endpoint, credentials):
    with pytest.raises(RouterUnreachable, match="no router answers"):
        open_session(endpoint, TURNED_AWAY_S, credentials=credentials)


def test_without_a_certificate_nobody_gets_in(endpoint):
    turned_away(endpoint, None)


def test_over_an_open_link_nobody_gets_in(endpoint):
    turned_away(endpoint.replace("tls/", "tcp/"), None)


def test_a_foreign_authoritys_certificate_lets_nobody_in(endpoint, identities):
    turned_away(endpoint, identities.foreign("robot.kitchen"))


def test_a_certificate_that_only_has_the_right_name_lets_nobody_in(endpoint, identities):
    turned_away(endpoint, identities.forged())


def test_an_expired_certificate_lets_nobody_in(endpoint, identities, monkeypatch):
    turned_away(endpoint, identities.expired(monkeypatch))


def test_a_pages_certificate_lets_nobody_in(endpoint, identities):
    turned_away(endpoint, identities.of("page.desk"))


def test_nobody_takes_a_foreign_router_for_a_true_one(identities):
    endpoint = f"tls/127.0.0.1:{free_port()}"
    router = open_router(endpoint, None, identities.foreign("router.kitchen"))
    try:
        turned_away(endpoint, identities.of("robot.kitchen"))
    finally:
        router.close()


def test_a_robots_certificate_makes_no_router(identities, tmp_path):
    shutil.copytree(identities.folder, tmp_path / "false")
    shutil.copy(tmp_path / "false" / "robot.kitchen.pem", tmp_path / "false" / "router.kitchen.pem")
    endpoint = f"tls/127.0.0.1:{free_port()}"
    router = open_router(endpoint, None, Credentials(tmp_path / "false", subject("router.kitchen")))
    try:
        turned_away(endpoint, identities.of("operator.anna"))
    finally:
        router.close()


def test_an_observer_stops_and_reads_and_commands_nothing(bus, robot):
    anna, carl = bus("operator.anna", "station-anna"), bus("observer.carl", "station-carl")
    reads = carl.subscribe(topics.SAFETY_STATE)

    def stopped():
        commands(carl)
        carl.publish(topics.EMERGENCY_STOP, EmergencyStop(pressed=True, by="carl"))
        anna.publish(topics.AUTHORITY_RENEWAL, AuthorityRenewal(holder="x", epoch=1))
        robot.bus.publish(topics.SAFETY_STATE, SafetyState(emergency_stop=True))
        heard.update(robot.heard())
        return reads.latest() and {("stop", "station-carl"), ("renewal", "station-anna")} <= heard

    heard = set()
    eventually(stopped, WITHIN_S, "the stop is heard")
    assert heard == {("stop", "station-carl"), ("renewal", "station-anna")}
    for query, request in (
        (queries.FINISH, queries.Finish(1)),
        (queries.REVOKE, queries.RevokeAuthority("carl", "mine")),
    ):
        outcome = eventually(carl.ask(query, request).poll, WITHIN_S, "nothing comes of it")
        assert isinstance(outcome, Failed)
        assert "may observer.carl ask" in outcome.reason
    assert robot.asked() == set()


def test_only_a_supervisor_ends_anothers_authority(bus, robot):
    request = queries.RevokeAuthority("anna", "because I say so")
    for name, process in (("operator.anna", "station-anna"), ("observer.carl", "station-carl")):
        assert isinstance(eventually(bus(name, process).ask(queries.REVOKE, request).poll, WITHIN_S, "no"), Failed)
    sue = bus("supervisor.sue", "station-sue")

    def revoked():
        sue.ask(queries.REVOKE, request)
        time.sleep(MOMENT_S)
        return robot.asked()

    assert eventually(revoked, WITHIN_S, "a supervisor is heard") == {"station-sue"}


def test_another_robots_certificate_neither_speaks_nor_hears_nor_answers_here(bus, robot):
    # Under the name of the process that it is at home: whoever forges that is no worse off.
    garage = bus("robot.garage", "robot", "garage").neighbour(ROBOT)
    carl = bus("observer.carl", "station-carl")
    state, overheard = carl.subscribe(topics.AUTHORITY_STATE), garage.subscribe(topics.AUTHORITY_RENEWAL)
    answers = garage.serve(queries.ACQUIRE)
    anna = bus("operator.anna", "station-anna")

    def told():
        garage.publish(topics.AUTHORITY_STATE, AuthorityState(holder="thief", epoch=9, expires_in=1.0))
        garage.publish(topics.EMERGENCY_STOP, EmergencyStop(pressed=True, by="thief"))
        robot.bus.publish(topics.AUTHORITY_STATE, AuthorityState(holder="x", epoch=1, expires_in=1.0))
        anna.publish(topics.AUTHORITY_RENEWAL, AuthorityRenewal(holder="x", epoch=1))
        return state.latest() and robot.renewal.latest()

    eventually(told, WITHIN_S, "the robot is heard")
    anna.ask(queries.ACQUIRE, queries.AcquireAuthority("x", "anna", request=5))
    eventually(lambda: robot.asked() == {"station-anna"}, WITHIN_S, "the robot alone is asked")
    assert state.latest().message.holder == "x"
    assert overheard.latest() is None
    assert answers.take() == []
    assert robot.stop.latest() is None


def test_nobody_speaks_in_anothers_name(identities, endpoint, bus, robot):
    """A session that shows one certificate, and a bus that calls itself another's process."""
    for false in ("station-anna", "robot"):
        session = open_session(endpoint, WITHIN_S, credentials=identities.of("operator.bob"))
        try:
            key = topics.AUTHORITY_RENEWAL.key(ROBOT, false)
            for _ in range(20):
                session.current.put(key, b"\x80")
            stop = topics.EMERGENCY_STOP.key(ROBOT, false)
            session.current.put(stop, b"\x80")
            time.sleep(MOMENT_S)
        finally:
            session.close()
    assert robot.renewal.drops.malformed == 0
    assert robot.stop.drops.malformed == 0


def test_who_is_revoked_is_cut_off_and_who_is_issued_let_in_while_the_router_runs(tmp_path):
    identities = Identities(tmp_path)
    endpoint = f"tls/127.0.0.1:{free_port()}"
    router = open_router(endpoint, None, identities.of("router.kitchen"))
    opened = []

    def join(name, process):
        opened.append(connect(endpoint, ROBOT, process, SystemClock(), credentials=identities.of(name)))
        return opened[-1]

    try:
        robot, anna, bob = join("robot.kitchen", "robot"), join("operator.anna", "station-anna"), None
        heard = robot.subscribe(topics.AUTHORITY_RENEWAL)

        def says(bus):
            bus.publish(topics.AUTHORITY_RENEWAL, AuthorityRenewal(holder="x", epoch=1))
            return {received.message.process for received in heard.take()}

        eventually(lambda: says(anna), WITHIN_S, "anna is heard")
        identities.authority.revoke("operator.anna")
        identities.authority.issue("operator.dora")
        eventually(lambda: router_changed(identities, endpoint), WITHIN_S, "the router knows")
        bob = join("operator.bob", "station-bob")
        eventually(lambda: "station-bob" in says(bob), WITHIN_S, "bob is heard")
        heard.take()
        deadline = time.monotonic() + 1.5
        while time.monotonic() < deadline:
            assert "station-anna" not in says(anna)
            time.sleep(0.05)
        dora = join("operator.dora", "station-dora")
        eventually(lambda: "station-dora" in says(dora), WITHIN_S, "dora is heard")
    finally:
        for bus in opened:
            bus.close()
        router.close()


def router_changed(identities, endpoint):
    """Whether the router lets in who was issued a certificate while it ran."""
    session = identities.session(endpoint, "operator.dora")
    heard = threading.Event()
    own = identities.session(endpoint, "router.garage")
    try:
        watch(own, f"retouch/@v1/*/{topics.HEARTBEAT.name}/*", lambda passing: heard.set())
        key = topics.HEARTBEAT.key(ROBOT, "station-dora")
        deadline = time.monotonic() + 1.0
        while not heard.wait(0.05) and time.monotonic() < deadline:
            session.current.put(key, b"")
        return heard.is_set()
    finally:
        session.close()
        own.close()


def test_a_renewed_certificate_is_used_from_the_next_connection_on(tmp_path):
    identities = Identities(tmp_path)
    endpoint = f"tls/127.0.0.1:{free_port()}"
    router = open_router(endpoint, None, identities.of("router.kitchen"))
    robot = connect(endpoint, ROBOT, "robot", SystemClock(), credentials=identities.of("robot.kitchen"))
    try:
        before = identities.of("robot.kitchen").file.read_bytes()
        identities.authority.renew("robot.kitchen")
        identities.authority.renew("router.kitchen")
        assert identities.of("robot.kitchen").file.read_bytes() != before
        anna = connect(endpoint, ROBOT, "station-anna", SystemClock(), credentials=identities.of("operator.anna"))
        try:
            heard = anna.subscribe(topics.SAFETY_STATE)

            def says():
                robot.publish(topics.SAFETY_STATE, SafetyState(emergency_stop=False))
                return heard.latest()

            eventually(says, WITHIN_S, "what is connected stays connected")
            router.close()
            router = open_router(endpoint, None, identities.of("router.kitchen"))
            before = heard.latest()
            eventually(lambda: says() is not before, WITHIN_S, "both are back")
        finally:
            anna.close()
    finally:
        robot.close()
        router.close()
