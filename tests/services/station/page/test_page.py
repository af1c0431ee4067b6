"""The page listens where it was told to, and says so as a browser understands it."""

import socket
import ssl
import urllib.parse
import urllib.request

import pytest

from services.certificates.authority import make_authority
from services.process.clock import SystemClock
from services.process.config import StationSection
from services.station.live_view.description import described
from services.station.page.page import Page
from sim.tasks.scene import Eye
from tests.ports import free_port
from tests.services.station.page.self_signed import self_signed
from tests.system.harness import eventually

UPGRADE = b"\r\n".join(
    (
        b"GET /link HTTP/1.1",
        b"Host: %s:%d",
        b"Origin: https://%s:%d",
        b"Connection: Upgrade",
        b"Upgrade: websocket",
        b"Sec-WebSocket-Version: 13",
        b"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
        b"",
        b"",
    )
)
"""RFC 6455, section 1.3."""

WITHIN_S = 20.0

GOODBYE = b"\x88\x82\x00\x00\x00\x00\x03\xe9"
"""A masked close frame, "going away"; section 5.5.1."""

GOING = b"\x88\x02\x03\xe9"
"""Its answer."""

NOTHING = described((), {}, Eye(), None)


def free_port_of_version_6(host):
    try:
        with socket.create_server((host, 0), family=socket.AF_INET6) as probe:
            return probe.getsockname()[1]
    except OSError:
        pytest.skip("this machine has no addresses of version 6")


def test_it_can_be_opened_under_an_address_of_version_6():
    page = Page(StationSection(host="::1", port=free_port_of_version_6("::1")), "robot1", SystemClock(), NOTHING)
    page.start()
    try:
        assert page.url.startswith("http://[::1]:")
        assert urllib.request.urlopen(page.url, timeout=10.0).status == 200
    finally:
        page.close()


def test_what_is_small_does_not_wait_until_what_came_before_it_was_acknowledged():
    station = StationSection(port=free_port())
    page = Page(station, "robot1", SystemClock(), NOTHING)
    page.start()
    try:
        with socket.create_connection(("127.0.0.1", station.port), timeout=10.0) as browser:
            browser.sendall(b"GET /assets/retouch.svg HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n")
            assert browser.recv(65_536).startswith(b"HTTP/1.1 200")
            (connection,) = page._server._server.server_state.connections
            accepted = connection.transport.get_extra_info("socket")
            assert accepted.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)
    finally:
        page.close()


def test_it_ends_quietly_while_a_browser_that_said_goodbye_still_holds_its_connection(tmp_path):
    certificate, key = self_signed(tmp_path, "page")
    station = StationSection(port=free_port(), certificate=str(certificate), key=str(key))
    page = Page(station, "robot1", SystemClock(), NOTHING)
    page.start()
    context = ssl.create_default_context()
    context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
    with context.wrap_socket(socket.create_connection(("127.0.0.1", station.port), timeout=10.0)) as browser:
        browser.sendall(UPGRADE % (b"127.0.0.1", station.port, b"127.0.0.1", station.port))
        assert browser.recv(65_536).startswith(b"HTTP/1.1 101")
        browser.sendall(GOODBYE)
        while received := browser.recv(65_536):
            if received.endswith(GOING):
                break
        page.close()  # what its thread cannot cope with fails this test, by pytest's own rule


@pytest.fixture
def authority(tmp_path):
    made = make_authority(tmp_path / "certs")
    made.issue("page.desk", hosts=("127.0.0.1",))
    return made


def serial(page, root):
    """Of the certificate that a browser is shown which trusts the authority, and looks at the host's name."""
    context = ssl.create_default_context(cafile=root)
    address = urllib.parse.urlsplit(page.url)
    with (
        socket.create_connection((address.hostname, address.port), timeout=10.0) as plain,
        context.wrap_socket(plain, server_hostname=address.hostname) as secured,
    ):
        return int(secured.getpeercert()["serialNumber"], 16)


def test_a_browser_that_trusts_the_authority_trusts_the_page_and_sees_a_renewed_certificate(authority):
    station = StationSection(port=free_port(), certificate=str(authority.folder / "page.desk.pem"))
    page = Page(station, "robot1", SystemClock(), NOTHING)
    page.start()
    try:
        root = authority.folder / "ca.pem"
        assert urllib.request.urlopen(page.url, timeout=10.0, context=ssl.create_default_context(cafile=root))
        assert page.attendance().page == f"{page.url}/"
        first = serial(page, root)
        authority.renew("page.desk")
        eventually(lambda: serial(page, root) != first, WITHIN_S, "the new one is shown")
    finally:
        page.close()
