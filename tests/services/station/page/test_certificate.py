"""A certificate is judged before the page is served, and what is wrong with it is one line."""

import shutil
import ssl

import pytest

from services.process.config import StationSection
from services.process.exceptions import UnusableSetting
from services.station.page.certificate import Renewal, check
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


class Shown(ssl.SSLContext):
    """What a page is served under; counts how often it is given a certificate."""

    times = 0

    def load_cert_chain(self, *arguments, **options):
        super().load_cert_chain(*arguments, **options)
        self.times += 1


def test_one_that_is_renewed_on_the_disk_is_shown_and_one_that_is_spoilt_is_not(tmp_path, caplog):
    names = ("one", "two")
    (certificate, key), (newer, its_key) = (self_signed(tmp_path, name) for name in names)
    context = Shown(ssl.PROTOCOL_TLS_SERVER)
    renewal = Renewal(StationSection(certificate=str(certificate), key=str(key)), context)
    renewal.look()
    assert context.times == 0
    newer.replace(certificate)
    renewal.look()
    assert context.times == 0
    assert "goes on with the certificate that it had" in caplog.text
    its_key.replace(key)
    renewal.look()
    renewal.look()
    assert context.times == 1


def test_a_certificate_that_is_gone_for_a_while_stays_as_it_was(tmp_path):
    certificate, key = self_signed(tmp_path, "one")
    context = Shown(ssl.PROTOCOL_TLS_SERVER)
    renewal = Renewal(StationSection(certificate=str(certificate), key=str(key)), context)
    shutil.move(certificate, tmp_path / "away.pem")
    renewal.look()
    shutil.move(tmp_path / "away.pem", certificate)
    renewal.look()
    assert context.times == 1
