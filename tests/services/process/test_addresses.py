"""A host is written as its kind of address wants it, wherever it stands."""

import socket

import pytest

from services.process.addresses import EVERYWHERE, LOOPBACK_NAMES, family, in_url, is_loopback


@pytest.mark.parametrize(
    ("host", "written", "of"),
    [
        ("127.0.0.1", "127.0.0.1", socket.AF_INET),
        ("robot.local", "robot.local", socket.AF_INET),
        ("2001:db8::7", "[2001:db8::7]", socket.AF_INET6),
    ],
)
def test_an_address_of_version_6_stands_in_brackets_and_has_a_family_of_its_own(host, written, of):
    assert (in_url(host), family(host)) == (written, of)


def test_whoever_listens_everywhere_is_reached_on_loopback():
    assert set(EVERYWHERE.values()) <= LOOPBACK_NAMES
    assert all(family(everywhere) is family(own) for everywhere, own in EVERYWHERE.items())


@pytest.mark.parametrize("host", [*sorted(LOOPBACK_NAMES), "127.0.0.2"])
def test_what_only_this_machine_reaches(host):
    assert is_loopback(host)


@pytest.mark.parametrize("host", [*EVERYWHERE, "192.0.2.1", "2001:db8::7", "desk.lan", "localhost.example", ""])
def test_what_others_may_reach(host):
    assert not is_loopback(host)
