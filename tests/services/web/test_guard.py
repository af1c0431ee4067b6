"""Who may ask the page's server, and by which name."""

import asyncio

import pytest

from services.web.guard import Guard, policy


def ask(host, *, listening="127.0.0.1", kind="http", origin=None, method="GET"):
    """What the server answers: "served", or the status of a refusal."""
    heard, said = [], []

    async def app(scope, receive, send):
        heard.append(scope)
        await send({"type": "http.response.start", "status": 200, "headers": []})

    async def send(message):
        said.append(message)

    async def receive():
        return {"type": "http.request"}

    headers = [(b"host", host.encode())] + ([(b"origin", origin.encode())] if origin else [])
    scope = {"type": kind, "path": "/assets/a.js", "headers": headers}
    if kind == "http":
        scope["method"] = method
    asyncio.run(Guard(app, listening, policy())(scope, receive, send))
    return dict(said[0]["headers"]) if heard else said[0].get("status", 403)


@pytest.mark.parametrize("host", ["127.0.0.1:8080", "localhost:8080", "[::1]:8080"])
def test_a_page_on_loopback_is_served_under_loopback_names(host):
    assert b"content-security-policy" in ask(host)


@pytest.mark.parametrize("host", ["evil.example:8080", "tablet.localhost:8080", "", "[::1", "[desk]:8080"])
def test_a_page_on_loopback_is_served_under_no_other_name(host):
    assert ask(host) == 403


def test_another_address_of_this_machine_alone_is_no_way_in_for_foreign_names_either():
    assert b"content-security-policy" in ask("127.0.0.2:8080", listening="127.0.0.2")
    assert ask("evil.example:8080", listening="127.0.0.2") == 403


@pytest.mark.parametrize("host", ["192.168.1.5:8080", "desk.example", "[fe80::1]:8080"])
def test_a_page_that_listens_on_every_address_is_served_under_any_name(host):
    assert b"content-security-policy" in ask(host, listening="0.0.0.0")


def test_the_link_is_opened_from_the_page_s_own_origin_only():
    own = ask("desk:8080", listening="0.0.0.0", kind="websocket", origin="http://desk:8080")
    assert b"content-security-policy" in own
    for origin in ("http://evil.example", "http://desk:9090", "http://[::1", "http://[desk]", None):
        assert ask("desk:8080", listening="0.0.0.0", kind="websocket", origin=origin) == 403


def test_what_changes_something_is_sent_from_the_page_s_own_origin_only():
    own = ask("desk:8080", listening="0.0.0.0", method="POST", origin="https://desk:8080")
    assert b"content-security-policy" in own
    for origin in ("http://evil.example", "http://desk:9090", "null", None):
        assert ask("desk:8080", listening="0.0.0.0", method="POST", origin=origin) == 403


def test_a_form_is_sent_to_the_page_s_own_server_with_its_origin():
    headers = ask("localhost")
    assert "form-action 'self'" in headers[b"content-security-policy"].decode()
    assert headers[b"referrer-policy"] == b"same-origin"


def test_no_other_server_and_no_frame_has_a_part_in_the_page():
    content = ask("localhost")[b"content-security-policy"].decode()
    assert "default-src 'self'" in content
    assert "frame-ancestors 'none'" in content
    assert "frame-src" not in content
    assert "unsafe" not in content


def test_one_page_shows_the_other_in_a_frame_where_both_are_told_so():
    assert "frame-src http://127.0.0.1:8080;" in policy(frames="http://127.0.0.1:8080")
    assert "frame-ancestors http://127.0.0.1:8090;" in policy(framed_by="http://127.0.0.1:8090")
