"""A host that nobody knows, a machine that refuses, one that does not answer and one that cannot be reached differ."""

import errno
import socket
import threading

import pytest

from services.bus import reach
from services.bus.reach import Silence
from services.commands.doctor import place
from services.commands.doctor.case import Case
from services.commands.doctor.finding import Verdict
from services.commands.doctor.place import check_name, check_port
from services.process.clock import SystemClock
from services.process.config import Configuration


def case(endpoint):
    return Case(Configuration(connect=endpoint), SystemClock(), threading.Event())


def only(findings):
    (finding,) = findings
    return finding


def refusing(error):
    def getaddrinfo(*_, **__):
        raise error

    return getaddrinfo


def test_an_address_needs_no_name():
    assert only(check_name(case("tcp/127.0.0.1:7447"))).verdict is Verdict.OK


def test_a_name_is_told_with_its_addresses():
    found = only(check_name(case("tcp/localhost:7447")))
    assert found.verdict is Verdict.OK
    assert "127.0.0.1" in found.found or "::1" in found.found


def test_a_host_that_nobody_knows(monkeypatch):
    monkeypatch.setattr(reach.socket, "getaddrinfo", refusing(socket.gaierror(socket.EAI_NONAME, "unknown")))
    found = only(check_name(case("tls/kitchn.lan:7447")))
    assert found.verdict is Verdict.WRONG
    assert "nobody here knows the host 'kitchn.lan'" in found.found
    assert "address" in found.remedy


def test_a_machine_without_a_name_server(monkeypatch):
    monkeypatch.setattr(reach.socket, "getaddrinfo", refusing(socket.gaierror(socket.EAI_AGAIN, "again")))
    found = only(check_name(case("tls/kitchen.lan:7447")))
    assert found.verdict is Verdict.WRONG
    assert "no name server answers" in found.found


@pytest.mark.parametrize("protocol", ["tcp", "tls"])
def test_somebody_who_listens_is_so_far_away(protocol):
    with socket.create_server(("127.0.0.1", 0)) as server:
        examined = case(f"{protocol}/127.0.0.1:{server.getsockname()[1]}")
        assert only(check_port(examined)).verdict is Verdict.OK
        assert 0.0 < examined.trip_s < 1.0


@pytest.mark.parametrize("protocol", ["tcp", "tls"])
def test_a_closed_port_is_refused(protocol):
    with socket.socket() as bound:
        bound.bind(("127.0.0.1", 0))
        examined = case(f"{protocol}/127.0.0.1:{bound.getsockname()[1]}")
        found = only(check_port(examined))
    assert found.verdict is Verdict.WRONG
    assert "the machine refuses" in found.found
    assert "retouch up" in found.remedy
    assert examined.trip_s is None


def test_a_machine_that_takes_no_packet_does_not_answer(monkeypatch):
    monkeypatch.setattr(reach, "PROBE_S", 0.3)
    with socket.socket() as deaf, socket.socket() as first, socket.socket() as second:
        deaf.bind(("127.0.0.1", 0))
        deaf.listen(0)
        for waiting in (first, second):  # as many as it lets wait: the kernel drops what comes after
            waiting.setblocking(False)
            waiting.connect_ex(deaf.getsockname())
        found = only(check_port(case(f"tcp/127.0.0.1:{deaf.getsockname()[1]}")))
    assert found.verdict is Verdict.WRONG
    assert "no answer from port" in found.found
    assert "firewall" in found.remedy


@pytest.mark.parametrize("code", [errno.ENETUNREACH, errno.EHOSTUNREACH])
def test_a_machine_to_which_no_way_leads(monkeypatch, code):
    monkeypatch.setattr(place, "knock", lambda endpoint: Silence("unreachable", code))
    found = only(check_port(case("tcp/127.0.0.1:7447")))
    assert found.verdict is Verdict.WRONG
    assert "no way leads to" in found.found


def test_a_long_way_is_to_be_looked_at(monkeypatch):
    monkeypatch.setattr(place, "knock", lambda endpoint: 0.25)
    found = only(check_port(case("tcp/127.0.0.1:7447")))
    assert found.verdict is Verdict.LOOK
    assert "250.0 ms" in found.found


def test_what_goes_without_tcp_is_not_asked():
    examined = case("quic/192.0.2.1:7447")
    assert only(check_port(examined)).verdict is Verdict.OK
    assert examined.trip_s == 0.0
