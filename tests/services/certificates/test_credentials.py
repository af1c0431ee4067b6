"""A process shows the certificate of its role, and an open endpoint is one only where somebody says so."""

import logging
from datetime import timedelta

import msgspec
import pytest

from services.certificates import expiry, register
from services.certificates.authority import make_authority
from services.certificates.credentials import check_secured, credentials, is_open, present
from services.certificates.exceptions import CertificateMissing, Unsecured
from services.process.config import Configuration

TLS = "tls/192.0.2.1:7447"
OPEN = "tcp/192.0.2.1:7447"


@pytest.fixture
def folder(tmp_path):
    authority = make_authority(tmp_path / "certs")
    for name in ("router.kitchen", "robot.kitchen", "operator.anna", "supervisor.anna", "observer.carl"):
        authority.issue(name)
    return tmp_path / "certs"


@pytest.fixture
def configured(folder):
    def make(**changes):
        settings = {"name": "kitchen", "operator": "anna", "connect": TLS, "tls": str(folder)}
        return msgspec.structs.replace(Configuration(), **settings | changes)

    return make


@pytest.mark.parametrize(
    ("role", "name"),
    [
        ("robot", "robot.kitchen"),
        ("station", "operator.anna"),
        ("master", "operator.anna"),
        ("router", "router.kitchen"),
        ("cli", "operator.anna"),
    ],
)
def test_a_process_shows_the_certificate_of_its_role(configured, folder, role, name):
    shown = credentials(configured(), TLS, role)
    assert (str(shown.subject), shown.file, shown.root) == (name, folder / f"{name}.pem", folder / "ca.pem")


def test_whoever_ends_an_authority_shows_a_supervisors(configured):
    assert str(credentials(configured(), TLS, revokes=True).subject) == "supervisor.anna"
    with pytest.raises(CertificateMissing, match=r"supervisor\.carl"):
        credentials(configured(operator="carl"), TLS, revokes=True)


@pytest.mark.parametrize("tool", ["cli", "teach", "history"])
def test_at_a_site_nobody_has_to_be_there_for_its_tools(configured, tool):
    shown = credentials(configured(operator="operator"), TLS, tool)
    assert (str(shown.subject), shown.process(tool)) == ("router.kitchen", f"{tool}-router")


def test_the_only_person_of_a_folder_has_not_to_be_named(configured, tmp_path):
    authority = make_authority(tmp_path / "one")
    authority.issue("operator.bob")
    assert present(configured(operator="operator", tls=str(tmp_path / "one"))) == "bob"
    assert present(configured(operator="operator")) == "operator"
    assert present(configured(operator="zoe")) == "zoe"


def test_a_certificate_that_is_missing_is_named_with_what_to_do(configured, tmp_path):
    with pytest.raises(CertificateMissing, match=r"robot\.garage.*certs issue"):
        credentials(configured(name="garage"), TLS, "robot")
    with pytest.raises(CertificateMissing, match="--operator anna or carl"):
        credentials(configured(operator="zoe"), TLS, "station")
    with pytest.raises(CertificateMissing, match="certs --help"):
        credentials(configured(tls=str(tmp_path / "nowhere")), TLS, "robot")


@pytest.mark.parametrize("endpoint", ["tcp/127.0.0.1:7447", "tcp/localhost:7447", "tcp/[::1]:7447", "udp/127.1.2.3:1"])
def test_this_machine_alone_needs_none(configured, endpoint):
    assert credentials(configured(), endpoint, "robot") is None


@pytest.mark.parametrize("endpoint", [OPEN, "udp/0.0.0.0:7447", "ws/robot.lan:7447"])
def test_what_is_open_to_others_is_refused_unless_that_is_said(configured, endpoint):
    with pytest.raises(Unsecured, match="--insecure"):
        check_secured(configured(), endpoint)
    assert credentials(configured(insecure=True), endpoint, "robot") is None
    assert is_open(configured(insecure=True, connect=endpoint))


def test_what_is_secured_is_not_open(configured):
    assert not is_open(configured(insecure=True))
    assert not is_open(configured())


@pytest.mark.parametrize(
    ("left", "says"),
    [(timedelta(days=2), ""), (timedelta(hours=7), "ends in 7 h"), (timedelta(seconds=-1), "has ended")],
)
def test_a_certificates_end_is_told_a_day_before(folder, left, says):
    file = folder / "robot.kitchen.pem"
    line = expiry.notice("robot.kitchen", file, expiry.ends(file) - left)
    assert says in line
    assert bool(line) == bool(says)
    assert not line or "certs renew robot.kitchen" in line


def test_a_process_tells_of_its_end_in_the_log(folder, configured, monkeypatch, caplog):
    soon = expiry.ends(folder / "robot.kitchen.pem") - timedelta(hours=3)
    monkeypatch.setattr(expiry, "now", lambda: soon)
    shown = credentials(configured(), TLS, "robot")
    with caplog.at_level(logging.WARNING):
        expiry.Expiry(shown).tell()
    assert "robot.kitchen ends in 3 h" in caplog.text


def test_a_register_knows_the_newest_certificate_of_each_name(folder):
    assert register.load(folder).find("robot.kitchen").generation == 0
    assert register.load(folder).find("robot.garage") is None
