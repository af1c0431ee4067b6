"""Each kind of fault between two machines is told as such, by real routers, certificates and sockets."""

import shutil
import socket
import threading
from datetime import timedelta

import msgspec
import pytest

from protocol.rights import subject
from services.bus.zenoh import open_router
from services.certificates import register
from services.certificates.credentials import Credentials
from services.commands.doctor.case import Case
from services.commands.doctor.examination import examine
from services.commands.doctor.finding import Verdict
from services.process.clock import SystemClock
from services.process.config import Configuration
from services.process.load import no_load
from tests.network.identities import Identities
from tests.network.standing import Standing
from tests.ports import free_port

pytestmark = pytest.mark.zenoh

OK, LOOK, WRONG, NOT_MADE = Verdict
ROBOT = "kitchen"


def examined(endpoint, folder="", **settings):
    """What the doctor finds."""
    settings = {"name": ROBOT, "operator": "anna", "connect": endpoint, "tls": str(folder)} | settings
    configuration = msgspec.structs.replace(Configuration(), **settings)
    case = Case(configuration, SystemClock(), threading.Event(), load=no_load)
    with case.open:
        return list(examine(case))


MEASURED = {"clock", "way", "pictures"}
"""What a machine that is busy with other tests may do badly: tests.network.test_doctor_far measures by itself."""


def wrong(findings):
    """What is wrong, but for what is measured: (check, what was found and what to do)."""
    faults = [one for one in findings if one.verdict is WRONG and one.check not in MEASURED]
    return [(one.check, f"{one.found}; {one.remedy}") for one in faults]


def only(findings, check, *said):
    """Nothing else is wrong, and that is told with these words."""
    ((name, told),) = wrong(findings)
    assert name == check
    for words in said:
        assert words in told
    return told


def not_made(findings):
    return {name for one in findings if one.verdict is NOT_MADE for name in one.check.split(", ")}


AFTER_THE_CERTIFICATE = {"router", "entry", "processes", "version", "clock", "way", "pictures", "rights"}


@pytest.fixture(scope="module")
def robot(identities, endpoint):
    """A robot at a router that lets in who shows a certificate."""
    with Standing(endpoint, ROBOT, identities.of("router.garage")) as standing:
        yield standing


@pytest.fixture
def router():
    """A function that opens a router, with a certificate or without."""
    opened = []

    def open_one(endpoint, credentials=None):
        opened.append(open_router(endpoint, None, credentials))
        return endpoint

    yield open_one
    for one in opened:
        one.close()


def tls(host="127.0.0.1"):
    return f"tls/{host}:{free_port()}"


@pytest.mark.usefixtures("robot")
@pytest.mark.parametrize("operator", ["anna", "carl", "sue"])
def test_where_all_is_well_nothing_is_wrong(identities, endpoint, operator):
    findings = examined(endpoint, identities.folder, operator=operator)
    assert wrong(findings) == []
    assert not_made(findings) == set()
    checks = [one.check for one in findings]
    assert set(checks) == {"name", "port", "certificate", *AFTER_THE_CERTIFICATE}
    told = " ".join(one.found for one in findings if one.check == "rights")
    assert {"anna": "command any robot", "carl": "leads none", "sue": "end the authority"}[operator] in told
    assert f"the model of {ROBOT} answers" in told


def test_an_examination_disturbs_nobody(identities, endpoint, robot):
    robot.probes.take(), robot.loads.take()
    examined(endpoint, identities.folder)
    heard = robot.loads.take()
    assert heard, "what loads the way passes through the router"
    assert sum(len(one.message.padding) for one in heard) <= 4e6
    assert {one.message.process for one in (*heard, *robot.probes.take())} == {"cli-anna"}


@pytest.mark.usefixtures("robot")
def test_another_robot_is_there(identities, endpoint):
    findings = examined(endpoint, identities.folder, name="garage")
    told = only(findings, "processes", "robot garage is not there")
    assert "--robot kitchen" in told
    assert not_made(findings) == {"clock"}


def test_a_foreign_authoritys_router(identities, router):
    findings = examined(router(tls(), identities.foreign("router.kitchen")), identities.folder)
    only(findings, "certificate", "(router.kitchen) was issued by another authority")
    assert not_made(findings) == AFTER_THE_CERTIFICATE


def test_a_router_whose_certificate_has_ended(tmp_path, router, monkeypatch):
    identities = Identities(tmp_path)
    true = register.now()
    monkeypatch.setattr(register, "now", lambda: true - timedelta(days=15))
    identities.authority.renew("router.kitchen", days=14)
    monkeypatch.undo()
    findings = examined(router(tls(), identities.of("router.kitchen")), identities.folder)
    only(findings, "certificate", "the router's (router.kitchen) has ended on", "certs renew router.kitchen")


def test_a_router_under_another_hosts_name(identities, router):
    findings = examined(router(tls("127.0.0.2"), identities.of("router.kitchen")), identities.folder)
    only(findings, "certificate", "is not for 127.0.0.2, but for localhost, 127.0.0.1", "--host 127.0.0.2")


def test_a_router_that_trusts_another_authority_refuses_after_the_handshake(identities, router, tmp_path):
    strict = tmp_path / "strict"
    strict.mkdir()
    shutil.copy(identities.foreign("router.kitchen").root, strict)
    for file in ("router.kitchen.pem", "issued.json"):
        shutil.copy(identities.folder / file, strict)
    findings = examined(router(tls(), Credentials(strict, subject("router.kitchen"))), identities.folder)
    only(findings, "certificate", "the router refuses operator.anna", "another authority")


def test_a_certificate_of_ones_own_that_has_ended(tmp_path, router, monkeypatch):
    identities = Identities(tmp_path)
    identities.expired(monkeypatch)
    findings = examined(router(tls(), identities.of("router.kitchen")), identities.folder, operator="old")
    only(findings, "certificate", "operator.old has ended on", "certs renew operator.old")


def test_no_certificate_of_ones_own(identities, endpoint, tmp_path):
    only(examined(endpoint, tmp_path), "certificate", "holds none for operator.anna", "certs --help")
    for file in ("ca.pem", "operator.anna.pem"):
        shutil.copy(identities.folder / file, tmp_path)
    only(examined(endpoint, tmp_path, operator="zoe"), "certificate", "operator.zoe", "--operator anna")


def test_one_that_was_revoked_is_let_in_and_lets_nothing_be_done(tmp_path, router):
    """The revoked one's machine has an older register than the router."""
    identities = Identities(tmp_path)
    shutil.copytree(identities.folder, tmp_path / "desk")
    identities.authority.revoke("operator.anna")
    findings = examined(router(tls(), identities.of("router.kitchen")), tmp_path / "desk")
    only(findings, "entry", "lets operator.anna in, and lets it do nothing: revoked", "issued.json")
    assert not_made(findings) == AFTER_THE_CERTIFICATE - {"router", "entry"}


def test_tls_where_none_is_spoken(identities, router):
    endpoint = router(tls().replace("tls/", "tcp/"))
    findings = examined(endpoint.replace("tcp/", "tls/"), identities.folder)
    only(findings, "certificate", "a router listens there that speaks without TLS", endpoint)


def test_no_tls_where_it_is_needed(endpoint):
    findings = examined(endpoint.replace("tls/", "tcp/"))
    only(findings, "router", "what listens there speaks TLS", f"connect to {endpoint}")


@pytest.fixture
def mute():
    """The port of a listener that accepts, and says nothing."""
    with socket.create_server(("127.0.0.1", 0), backlog=64) as server:
        yield server.getsockname()[1]


def test_a_listener_that_says_nothing(identities, mute):
    only(examined(f"tcp/127.0.0.1:{mute}"), "router", "does not answer as a router")
    only(
        examined(f"tls/127.0.0.1:{mute}", identities.folder), "certificate", "does not answer with TLS", "said nothing"
    )


def test_nobody_listens():
    findings = examined(f"tcp/127.0.0.1:{free_port()}")
    only(findings, "port", "the machine refuses")
    assert not_made(findings) == AFTER_THE_CERTIFICATE


def test_a_host_that_is_not_known(identities, monkeypatch):
    def unknown(*_, **__):
        raise socket.gaierror(socket.EAI_NONAME, "unknown")

    monkeypatch.setattr(socket, "getaddrinfo", unknown)
    findings = examined("tls/kitchn.lan:7447", identities.folder)
    only(findings, "name", "'kitchn.lan'")
    assert not_made(findings) == {"port", *AFTER_THE_CERTIFICATE}


def test_no_robot_is_there(router):
    endpoint = router(f"tcp/127.0.0.1:{free_port()}")
    only(examined(endpoint), "processes", "no process of any robot was heard")


def test_at_the_site_the_routers_own_certificate_will_do(identities, endpoint, robot):
    findings = examined(endpoint, identities.folder, operator="operator")
    assert wrong(findings) == []
    assert " is a router's: what it passes on" in " ".join(one.found for one in findings)
