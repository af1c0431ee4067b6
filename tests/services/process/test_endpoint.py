"""An endpoint is judged as it is read: what can be one is, and what cannot is told with what would be right."""

import pytest

from services.process.config import Configuration, load
from services.process.endpoint import PROTOCOLS, Endpoint, parse
from services.process.exceptions import BadEndpoint, ConfigurationError


@pytest.mark.parametrize("protocol", PROTOCOLS)
def test_every_protocol_of_the_transport_has_a_host_and_a_port(protocol):
    text = f"{protocol}/robot-1.lab:7447"
    assert parse(text) == Endpoint(text, protocol, "robot-1.lab", 7447)


def test_an_address_of_version_6_stands_in_brackets():
    assert parse("tcp/[fe80::1%eth0]:7447").host == "fe80::1%eth0"


def test_the_transports_own_settings_are_left_to_it():
    text = "tcp/127.0.0.1:7447?prio=1-3#so_sndbuf=65000"
    assert parse(text) == Endpoint(text, "tcp", "127.0.0.1", 7447)


@pytest.mark.parametrize(
    ("text", "wrong", "right"),
    [
        ("", "empty", "tcp/192.0.2.1:7447"),
        ("  ", "empty", "tcp/192.0.2.1:7447"),
        ("tcp://192.0.2.7:7447", "single slash", "tcp/192.0.2.7:7447"),
        ("http://robot:80", "single slash", "tcp/robot:80"),
        ("192.0.2.7:7447", "no protocol", "tcp/192.0.2.7:7447"),
        ("192.0.2.7", "no protocol", "tcp/192.0.2.7:7447"),
        ("tcp:192.0.2.7:7447", "no protocol", "tcp/192.0.2.7:7447"),
        ("http/robot:80", "'http'", "tcp/robot:80"),
        ("TCP/robot:80", "'TCP'", "tcp/robot:80"),
        (" tcp/robot:80", "' tcp'", "tcp/robot:80"),
        ("tcp/robot", "no port", "tcp/robot:7447"),
        ("tls/[::1]", "no port", "tls/[::1]:7447"),
        ("tcp/", "no port", "tcp/192.0.2.1:7447"),
        ("tcp/robot:", "''", "tcp/robot:7447"),
        ("tcp/robot:0", "'0'", "tcp/robot:7447"),
        ("tcp/robot:99999", "'99999'", "tcp/robot:7447"),
        ("tcp/robot:-1", "'-1'", "tcp/robot:7447"),
        ("tcp/robot:7447/", "'7447/'", "tcp/robot:7447"),
        ("tcp/robot:٧٤٤٧", "'٧٤٤٧'", "tcp/robot:7447"),
        ("tcp/robot:" + "7" * 5000, "7777", "tcp/robot:7447"),
        ("tcp/:7447", "no host", "tcp/127.0.0.1:7447"),
        ("tcp/::1:7447", "brackets", "tcp/[::1]:7447"),
        ("tcp/my robot:7447", "'my robot'", "tcp/192.0.2.1:7447"),
        ("tcp/-x:7447", "'-x'", "tcp/192.0.2.1:7447"),
        ("tcp/robot\n:7447", "'robot\\n'", "tcp/192.0.2.1:7447"),
    ],
)
def test_what_is_no_endpoint_is_told_with_what_would_be_right(text, wrong, right):
    with pytest.raises(BadEndpoint) as caught:
        parse(text)
    assert wrong in caught.value.reason
    assert caught.value.right == right
    assert "\n" not in str(caught.value)
    assert parse(right).text == right


@pytest.mark.parametrize("key", ["connect", "listen"])
def test_the_configurations_endpoints_are_judged_where_they_are_read(tmp_path, key):
    path = tmp_path / "retouch.toml"
    path.write_text(f'{key} = "tcp/robot"')
    with pytest.raises(ConfigurationError, match=r"retouch\.toml.*names no port"):
        load(path)
    with pytest.raises(BadEndpoint, match="names no port"):
        Configuration(**{key: "tcp/robot"})
