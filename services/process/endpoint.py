"""Where a router is, as a person writes it: `tcp/192.0.2.1:7447`. Judged at once, before anything waits for it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from ipaddress import ip_address

from services.process.addresses import is_loopback
from services.process.exceptions import BadEndpoint

PROTOCOLS = ("tcp", "tls", "quic", "udp", "ws")
"""Which the transport speaks between machines."""

OVER_TCP = ("tcp", "tls", "ws")

SECURE = ("tls", "quic")
"""Which show each end who the other one is, and nobody else what passes."""

DEFAULT_PORT = 7447
LAST_PORT = 65535

_PARTS = re.compile(r"(\[[^\]]*\]|[^:]*):?(.*)", re.DOTALL)
_DIGITS = re.compile(r"[0-9]{1,5}")
_NAME = re.compile(r"[A-Za-z0-9_]([A-Za-z0-9_.-]*[A-Za-z0-9_.])?")
_BRACKETED = re.compile(r"\[([0-9A-Fa-f:.]+(?:%[A-Za-z0-9_.-]+)?)\]")


@dataclass(frozen=True)
class Endpoint:
    """An endpoint that can be one.

    Attributes:
        text: as it was written, with the transport's own settings where it has some.
        protocol: one of `PROTOCOLS`.
        host: a name or an address, without brackets.
        port: from 1 to 65535.
    """

    text: str
    protocol: str
    host: str
    port: int

    @property
    def is_loopback(self) -> bool:
        """Whether it is on this machine, and no network leads there."""
        return is_loopback(self.host)

    @property
    def datagrams(self) -> str:
        """The endpoint of datagrams beside it; empty on this machine alone, and where what travels is encrypted."""
        return self.text.replace("tcp/", "udp/", 1) if self.protocol == "tcp" and not self.is_loopback else ""

    @property
    def is_address(self) -> bool:
        """Whether the host is an address, and no name that has to be looked up."""
        try:
            ip_address(self.host)
        except ValueError:
            return False
        return True

    @property
    def secure(self) -> bool:
        """Whether nobody can listen in on it."""
        return self.protocol in SECURE


def parse(text: str) -> Endpoint:
    """The endpoint in a text.

    Raises:
        BadEndpoint: it is none; says what is wrong and what would be right.
    """
    protocol, slash, rest = text.partition("/")
    if not text.strip():
        raise BadEndpoint(text, "it is empty", _right())
    if "://" in text:
        address = text.partition("://")[2]
        raise BadEndpoint(text, "it is written like a web address; a single slash belongs there", _right(address))
    if not slash:
        _, colon, rest = text.partition(":")
        address = rest if colon and text.startswith(tuple(f"{one}:" for one in PROTOCOLS)) else text
        raise BadEndpoint(text, f"it names no protocol: one of {', '.join(PROTOCOLS)}, and a slash", _right(address))
    if protocol not in PROTOCOLS:
        raise BadEndpoint(text, f"there is no protocol {protocol!r}, only {', '.join(PROTOCOLS)}", _right(rest))
    address = re.split(r"[?#]", rest, maxsplit=1)[0]
    host, port = _host_and_port(text, protocol, address)
    return Endpoint(text, protocol, host, port)


def _host_and_port(text: str, protocol: str, address: str) -> tuple[str, int]:
    host, colon, port = address.rpartition(":")
    if not colon or address.endswith("]"):
        raise BadEndpoint(text, "it names no port", _right(address, protocol))
    if not host:
        raise BadEndpoint(text, "it names no host", _right(f"127.0.0.1:{port}", protocol))
    if not _is_port(port):
        right = _right(host, protocol)
        raise BadEndpoint(text, f"{port!r} is no port: a whole number from 1 to {LAST_PORT}", right)
    bracketed = _BRACKETED.fullmatch(host)
    if bracketed is not None:
        return bracketed[1], int(port)
    if ":" in host:
        right = _right(f"[{host.strip('[]')}]:{port}", protocol)
        raise BadEndpoint(text, "an address of version 6 stands in brackets", right)
    if not _NAME.fullmatch(host):
        raise BadEndpoint(text, f"{host!r} is neither a host's name nor an address", _right(protocol=protocol))
    return host, int(port)


def _is_port(text: str) -> bool:
    return _DIGITS.fullmatch(text) is not None and 1 <= int(text) <= LAST_PORT


def _right(address: str = "", protocol: str = "tcp") -> str:
    """What the person may have meant; an example where that cannot be guessed."""
    host, port = _PARTS.fullmatch(address.strip().strip("/")).groups()  # type: ignore[union-attr]  # matches any text
    known = _NAME.fullmatch(host) or _BRACKETED.fullmatch(host)
    return f"{protocol}/{host if known else '192.0.2.1'}:{port if _is_port(port) else DEFAULT_PORT}"
