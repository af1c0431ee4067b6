"""A certificate is judged before the page is served, and what is wrong with it is one line."""

import pytest

from services.process.config import StationSection
from services.process.exceptions import UnusableSetting
from services.station.page.certificate import check
from tests.services.station.page.self_signed import self_signed


def fault(certificate="", key=""):
    """What is wrong."""
    with pytest.raises(UnusableSetting) as caught:
        check(StationSection(certificate=str(certificate), key=str(key)))
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_without_a_certificate_there_is_nothing_to_judge():
    check(StationSection())
    assert StationSection().scheme == "http"


def test_a_certificate_and_its_key_can_be_used_in_two_files_or_in_one(tmp_path):
    certificate, key = self_signed(tmp_path, "one")
    check(StationSection(certificate=str(certificate), key=str(key)))
    certificate.write_bytes(certificate.read_bytes() + key.read_bytes())
    check(StationSection(certificate=str(certificate)))
    assert StationSection(certificate="x").scheme == "https"


def test_a_key_of_another_certificate_is_said_to_be_one(tmp_path):
    (certificate, _), (_, key) = self_signed(tmp_path, "one"), self_signed(tmp_path, "two")
    assert "do not belong together" in fault(certificate, key)


def test_a_file_that_is_not_there_is_named_with_its_setting(tmp_path):
    assert fault(tmp_path / "absent.pem") == f"[station] certificate: {tmp_path}/absent.pem: no such file or directory"


def test_a_file_of_another_kind_is_said_to_be_none(tmp_path):
    (tmp_path / "words.pem").write_text("words")
    assert "no PEM file of its kind" in fault(tmp_path / "words.pem")


def test_a_key_alone_is_of_no_use():
    assert fault(key="key.pem").startswith("[station] key: key.pem is of no use alone")
