"""The viewer's page: it asks nobody else, and it is there under whatever name the browser knows it by."""

import gzip
import http.client
import socket

import msgspec
import pytest

from services.process.config import ViewerSection
from services.process.exceptions import PortInUse
from services.viewer.web import WebServer


def get(port, path, host=None):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=5)
    connection.request("GET", path, headers={} if host is None else {"Host": host})
    response = connection.getresponse()
    body = response.read()
    connection.close()
    return response, body


@pytest.fixture
def serve(configuration, files):
    """A function that serves the page on an address; returns its port and the stream's."""
    servers = []

    def serve_(host="127.0.0.1"):
        section = msgspec.structs.replace(configuration.viewer, host=host)
        servers.append(WebServer(section, files))
        return section.web_port, section.stream_port

    yield serve_
    for server in servers:
        server.close()


def sources(response, directive):
    policy = dict(part.split(" ", 1) for part in response.getheader("Content-Security-Policy").split("; "))
    return policy[directive].split()


def test_the_page_names_the_streams_port_and_may_load_nothing_from_elsewhere(serve):
    web_port, stream_port = serve()
    response, page = get(web_port, "/?anything")
    assert f'data-stream-port="{stream_port}"'.encode() in page
    assert sources(response, "default-src") == ["'none'"]
    assert sources(response, "connect-src") == ["'self'", f"http://127.0.0.1:{stream_port}"]


@pytest.mark.parametrize("name", ["desk.local", "192.168.1.5", "robot-lab"])
def test_on_every_address_the_stream_is_where_this_browser_finds_the_page(serve, name):
    web_port, stream_port = serve("0.0.0.0")
    response, _ = get(web_port, "/", f"{name}:{web_port}")
    assert response.status == http.HTTPStatus.OK
    assert sources(response, "connect-src") == ["'self'", f"http://{name}:{stream_port}"]


@pytest.mark.parametrize("name", ["127.0.0.1", "localhost", "[::1]"])
def test_on_loopback_every_loopback_name_is_answered_and_no_page_may_hold_it(serve, name):
    web_port, _ = serve()
    response, _ = get(web_port, "/", f"{name}:{web_port}")
    assert response.status == http.HTTPStatus.OK
    assert sources(response, "frame-ancestors") == ["'none'"]


@pytest.mark.parametrize("name", ["evil.example", "192.168.1.5", "localhost; script-src *", ""])
def test_on_loopback_no_foreign_name_is_answered(serve, name):
    web_port, _ = serve()
    response, _ = get(web_port, "/", name)
    assert response.status == http.HTTPStatus.MISDIRECTED_REQUEST


def test_a_name_that_is_none_cannot_add_to_the_policy(serve):
    web_port, _ = serve("0.0.0.0")
    response, _ = get(web_port, "/", "desk; script-src *")
    assert response.status == http.HTTPStatus.MISDIRECTED_REQUEST


def test_the_sdks_files_are_served_compressed_and_no_other_file_is(serve):
    web_port, _ = serve()
    response, body = get(web_port, "/re_viewer_bg.wasm")
    assert response.getheader("Content-Encoding") == "gzip"
    assert gzip.decompress(body) == b"re_viewer_bg.wasm"
    response, _ = get(web_port, "/../web.py")
    assert response.status == http.HTTPStatus.NOT_FOUND


def test_a_port_in_use_is_named_with_its_setting(configuration, files):
    with (
        socket.create_server(("127.0.0.1", configuration.viewer.web_port)),
        pytest.raises(PortInUse, match="web_port"),
    ):
        WebServer(configuration.viewer, files)


def test_a_page_under_an_address_of_version_6_may_read_the_stream():
    from services.viewer.live import page_origins

    assert "http://[2001:db8::7]:82" in page_origins(ViewerSection(host="2001:db8::7", web_port=82))
