"""A page that others open has a certificate, this machine's own where it names none; it opens nothing else."""

import msgspec
import pytest
from cryptography import x509
from cryptography.x509.oid import ExtendedKeyUsageOID

from protocol.rights import KINDS, SITE, rights, subject
from services.bus.zenoh.access import access_control, quotas
from services.certificates.authority import make_authority
from services.certificates.exceptions import CannotIssue, Unsecured
from services.certificates.page import address, hosts, is_plain, of_page, secured
from services.process.config import Configuration, StationSection
from services.process.exceptions import UnusableSetting

OPEN = ("0.0.0.0", "::", "192.0.2.1", "desk.lan")


@pytest.fixture
def authority(tmp_path):
    return make_authority(tmp_path / "certs")


@pytest.fixture
def configured(authority):
    def make(host="0.0.0.0", name="kitchen", insecure=False, **station):
        section = StationSection(host=host, **station)
        return msgspec.structs.replace(
            Configuration(), name=name, tls=str(authority.folder), insecure=insecure, station=section
        )

    return make


def test_it_vouches_for_its_hosts_alone_to_browsers_alone(authority):
    authority.issue("page.desk", hosts=("desk.lan", "192.0.2.7"))
    file = authority.folder / "page.desk.pem"
    made = x509.load_pem_x509_certificate(file.read_bytes())
    made.verify_directly_issued_by(x509.load_pem_x509_certificate((authority.folder / "ca.pem").read_bytes()))
    usage = made.extensions.get_extension_for_class(x509.ExtendedKeyUsage).value
    assert list(usage) == [ExtendedKeyUsageOID.SERVER_AUTH]
    assert hosts(file) == ("desk.lan", "192.0.2.7")
    authority.renew("page.desk")
    assert hosts(file) == ("desk.lan", "192.0.2.7")


def test_it_is_of_no_use_on_the_network(authority):
    assert list(rights(subject("page.desk"))) == []
    assert "page" not in SITE
    authority.issue("operator.anna")
    before = authority.register.admitted()
    authority.issue("page.desk", hosts=("desk.lan",))
    assert authority.register.admitted() == before
    subjects = [(one.common_name, one.subject) for one in authority.register.admitted()]
    assert "page" not in str((access_control(subjects), quotas(subjects)))


@pytest.mark.parametrize(
    "host", ["desk.lan:8080", "https://desk.lan", "desk lan", "bücher.lan", "", "-desk", "*", "a" * 300]
)
def test_what_is_no_host_is_named(authority, host):
    for name in ("page.desk", "router.kitchen"):
        with pytest.raises(CannotIssue, match=r"neither a host's name nor an address"):
            authority.issue(name, hosts=("desk.lan", host))
    assert authority.register.issued == ()


def test_a_page_s_certificate_has_to_say_where_it_is_opened(authority):
    with pytest.raises(CannotIssue, match="say with --host"):
        authority.issue("page.desk")


@pytest.mark.parametrize("host", OPEN)
def test_a_page_that_others_open_uses_the_one_that_this_machine_has(authority, configured, host):
    authority.issue("operator.anna")
    authority.issue("page.desk", hosts=("desk.lan",))
    served = secured(configured(host))
    assert (served.certificate, served.key) == (str(authority.folder / "page.desk.pem"), "")
    assert served.scheme == "https"
    assert not is_plain(configured(host))
    assert str(of_page(configured(host)).subject) == "page.desk"


def test_the_certificate_that_the_configuration_names_counts(authority, configured):
    authority.issue("page.desk", hosts=("desk.lan",))
    named = configured(certificate="own.pem", key="own.key")
    assert secured(named) == named.station
    assert of_page(named) is None


def test_of_several_it_is_the_robots(authority, configured):
    for name in ("page.desk", "page.kitchen"):
        authority.issue(name, hosts=("desk.lan",))
    assert secured(configured(name="kitchen")).certificate.endswith("page.kitchen.pem")
    with pytest.raises(UnusableSetting, match=r"^\[station\] certificate: .*page\.desk\.pem, page\.kitchen\.pem"):
        secured(configured(name="garage"))


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "::1"])
def test_a_page_of_this_machine_alone_needs_none(authority, configured, host):
    authority.issue("page.desk", hosts=("desk.lan",))
    assert secured(configured(host)) == configured(host).station
    assert not is_plain(configured(host))


@pytest.mark.parametrize("host", OPEN)
def test_without_one_it_is_open_to_others_only_where_that_is_said(configured, host):
    with pytest.raises(Unsecured, match=r"certs issue page\.NAME --host HOST.*--insecure") as caught:
        secured(configured(host))
    assert "\n" not in str(caught.value)
    assert secured(configured(host, insecure=True)).scheme == "http"
    assert is_plain(configured(host, insecure=True))


def test_its_address_is_one_that_its_certificate_vouches_for(authority, configured):
    authority.issue("page.desk", hosts=("*.lan", "desk.lan", "192.0.2.7"))
    assert address(secured(configured("0.0.0.0")), "here") == "https://desk.lan:8080/"
    assert address(secured(configured("192.0.2.7")), "here") == "https://192.0.2.7:8080/"
    assert address(StationSection(host="::"), "2001:db8::7") == "http://[2001:db8::7]:8080/"
    assert address(StationSection(host="0.0.0.0", certificate="missing.pem"), "here") == "https://here:8080/"


def test_every_kind_that_is_dialled_is_a_router_or_a_page():
    assert {kind.name for kind in KINDS if kind.dialled} == {"router", "page"}
