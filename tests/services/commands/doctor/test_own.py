"""A certificate is judged by itself: there, whole, of the authority beside it, in its time, and not revoked."""

import shutil
from datetime import timedelta

import pytest

from protocol.rights import subject
from services.certificates import register
from services.certificates.authority import make_authority
from services.certificates.credentials import Credentials
from services.commands.doctor.finding import Verdict
from services.commands.doctor.own import examined

ANNA = "operator.anna"


@pytest.fixture
def authority(tmp_path):
    made = make_authority(tmp_path / "certs")
    made.issue(ANNA)
    return made


@pytest.fixture
def shown(authority):
    return Credentials(authority.folder, subject(ANNA))


def test_one_that_counts(shown):
    found = examined(shown, register.now())
    assert found.verdict is Verdict.OK
    assert "operator.anna is valid until" in found.found


def test_one_that_ends_within_a_day(shown):
    found = examined(shown, register.now() + timedelta(days=13, hours=20))
    assert found.verdict is Verdict.LOOK
    assert "certs renew operator.anna" in found.remedy


def test_one_that_has_ended(shown):
    found = examined(shown, register.now() + timedelta(days=15))
    assert found.verdict is Verdict.WRONG
    assert "operator.anna has ended on" in found.found
    assert "certs renew operator.anna" in found.remedy


def test_one_that_is_not_valid_yet_means_a_wrong_clock(shown):
    found = examined(shown, register.now() - timedelta(hours=1))
    assert found.verdict is Verdict.WRONG
    assert "is valid from" in found.found
    assert "clock" in found.remedy


def test_one_whose_authority_has_ended(shown):
    found = examined(shown, register.now() + timedelta(days=3651))
    assert found.verdict is Verdict.WRONG
    assert "its authority has ended" in found.found


def test_one_that_is_revoked_says_the_register_beside_it(authority, shown):
    authority.revoke(ANNA)
    found = examined(shown, register.now())
    assert found.verdict is Verdict.WRONG
    assert "was revoked" in found.found
    assert "certs issue operator.anna" in found.remedy


def test_an_old_one_of_a_name_that_has_a_newer_one_since_is_revoked(authority, shown, tmp_path):
    authority.revoke(ANNA)
    authority.issue(ANNA, to=tmp_path / "new")
    assert examined(shown, register.now()).verdict is Verdict.WRONG
    assert examined(Credentials(tmp_path / "new", subject(ANNA)), register.now()).verdict is Verdict.OK


def test_one_that_another_authority_issued(authority, tmp_path):
    other = make_authority(tmp_path / "other")
    other.issue(ANNA)
    shutil.copy(authority.folder / "ca.pem", other.folder)
    found = examined(Credentials(other.folder, subject(ANNA)), register.now())
    assert found.verdict is Verdict.WRONG
    assert "was not issued by the authority" in found.found


@pytest.mark.parametrize("file", ["operator.anna.pem", "ca.pem", "issued.json"])
def test_a_file_that_holds_something_else(shown, file):
    (shown.folder / file).write_text("nonsense")
    found = examined(shown, register.now())
    assert found.verdict is Verdict.WRONG
    assert "cannot be used" in found.found


def test_one_that_is_not_there(shown):
    shown.root.unlink()
    found = examined(shown, register.now())
    assert found.verdict is Verdict.WRONG
    assert "ca.pem" in found.found
