"""An authority issues what a handshake accepts, keeps its keys to itself, and is never overwritten."""

import ssl
import stat
from datetime import timedelta
from ipaddress import ip_address

import pytest
from cryptography import x509
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

from services.certificates import register
from services.certificates.authority import DAYS, Authority, make_authority
from services.certificates.exceptions import AuthorityThere, CannotIssue, NoAuthority, Unreadable


@pytest.fixture
def authority(tmp_path):
    return make_authority(tmp_path / "certs")


def certificate(path):
    return x509.load_pem_x509_certificate(path.read_bytes())


def common_name(path):
    return certificate(path).subject.get_attributes_for_oid(NameOID.COMMON_NAME)[0].value


def mode(path):
    return stat.S_IMODE(path.stat().st_mode)


def test_an_authority_that_is_there_stays(authority):
    before = (authority.folder / "ca.pem").read_bytes()
    with pytest.raises(AuthorityThere):
        make_authority(authority.folder)
    assert (authority.folder / "ca.pem").read_bytes() == before


def test_keys_are_their_owners_alone(authority):
    authority.issue("operator.anna")
    assert mode(authority.folder) == 0o700
    assert {mode(authority.folder / name) for name in ("ca.key", "operator.anna.pem")} == {0o600}


def test_a_certificate_says_whom_it_is_for_and_is_signed_by_the_authority(authority):
    issued = authority.issue("operator.anna")
    made = certificate(authority.folder / "operator.anna.pem")
    made.verify_directly_issued_by(certificate(authority.folder / "ca.pem"))
    assert common_name(authority.folder / "operator.anna.pem") == "operator.anna"
    assert made.not_valid_after_utc == issued.until
    assert timedelta(days=DAYS - 1) < issued.until - register.now() <= timedelta(days=DAYS)
    ssl.create_default_context().load_cert_chain(authority.folder / "operator.anna.pem")


def test_only_a_router_can_be_dialled_and_only_under_its_own_hosts(authority):
    authority.issue("router.kitchen", hosts=("192.0.2.1", "kitchen.lan"))
    authority.issue("robot.kitchen")
    router, robot = (certificate(authority.folder / f"{kind}.kitchen.pem") for kind in ("router", "robot"))
    usages = [made.extensions.get_extension_for_class(x509.ExtendedKeyUsage).value for made in (router, robot)]
    assert [ExtendedKeyUsageOID.SERVER_AUTH in usage for usage in usages] == [True, False]
    hosts = router.extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    assert set(hosts.get_values_for_type(x509.IPAddress)) == {ip_address(a) for a in ("127.0.0.1", "::1", "192.0.2.1")}
    assert set(hosts.get_values_for_type(x509.DNSName)) == {"localhost", "kitchen.lan"}


def test_whom_a_folder_is_for_gets_what_is_needed_and_no_key_of_anybody_else(authority, tmp_path):
    authority.issue("router.kitchen", to=tmp_path / "kitchen")
    authority.issue("robot.kitchen", to=tmp_path / "kitchen")
    assert {file.name for file in (tmp_path / "kitchen").iterdir()} == {
        *("ca.pem", "issued.json", "router.kitchen.pem", "robot.kitchen.pem")
    }
    assert {file.name for file in authority.folder.iterdir()} == {"ca.key", "ca.pem", "issued.json"}
    assert register.load(tmp_path / "kitchen") == authority.register


def test_a_renewed_certificate_has_the_same_name_and_hosts_and_another_key(authority):
    path = authority.folder / "router.kitchen.pem"
    authority.issue("router.kitchen", days=1, hosts=("192.0.2.1",))
    before = certificate(path)
    renewed = authority.renew("router.kitchen", days=30)
    assert common_name(path) == "router.kitchen"
    assert certificate(path).public_key() != before.public_key()
    assert renewed.hosts == ("192.0.2.1",)
    assert renewed.until > before.not_valid_after_utc


def test_after_a_revocation_the_name_in_the_certificate_is_another_one(authority):
    authority.issue("operator.anna")
    authority.revoke("operator.anna")
    assert authority.register.admitted() == ()
    authority.issue("operator.anna")
    assert common_name(authority.folder / "operator.anna.pem") == "operator.anna~1"
    (valid,) = authority.register.admitted()
    assert (valid.common_name, str(valid.subject)) == ("operator.anna~1", "operator.anna")


@pytest.mark.parametrize(
    ("act", "why"),
    [
        (lambda a: a.issue("operator.anna"), "renew or revoke"),
        (lambda a: a.renew("operator.bob"), "no certificate was issued"),
        (lambda a: a.revoke("operator.bob"), "no certificate was issued"),
        (lambda a: a.issue("king.anna"), "no name of a certificate"),
        (lambda a: a.issue("operator.operator"), "give the person's own"),
        (lambda a: a.issue("operator.bob", days=4000), "from 1 to"),
        (lambda a: (a.revoke("operator.anna"), a.renew("operator.anna")), "was revoked"),
    ],
)
def test_what_cannot_be_issued_says_why_and_changes_nothing_else(authority, act, why):
    authority.issue("operator.anna")
    with pytest.raises(CannotIssue, match=why):
        act(authority)
    assert [one.name for one in authority.register.issued] == ["operator.anna"]


def test_what_is_kept_is_found_again(authority):
    authority.issue("operator.anna")
    assert Authority(authority.folder).register == authority.register


def test_a_folder_without_an_authority_says_so(tmp_path):
    with pytest.raises(NoAuthority, match="certs init"):
        Authority(tmp_path)


@pytest.mark.parametrize("name", ["ca.pem", "ca.key", "issued.json"])
def test_a_file_that_holds_something_else_is_named(authority, name):
    (authority.folder / name).write_text("nonsense")
    with pytest.raises(Unreadable):
        Authority(authority.folder)


def test_an_authority_that_a_power_cut_left_half_made_is_made_to_its_end(tmp_path):
    make_authority(tmp_path / "whole")
    (tmp_path / "half").mkdir()
    key = (tmp_path / "whole" / "ca.key").read_bytes()
    (tmp_path / "half" / "ca.key").write_bytes(key)
    authority = make_authority(tmp_path / "half")
    assert (tmp_path / "half" / "ca.key").read_bytes() == key, "somebody may have certificates of it"
    authority.issue("operator.anna")


def test_a_key_that_is_none_is_not_taken_for_a_half_made_authority(tmp_path):
    (tmp_path / "ca.key").write_bytes(b"none")
    with pytest.raises(Unreadable, match="it is no key"):
        make_authority(tmp_path)
