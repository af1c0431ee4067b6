"""Host names and addresses: which mean this machine only, which every address of it, and how they are written."""

from __future__ import annotations

import socket
from collections.abc import Mapping
from ipaddress import ip_address

LOOPBACK_NAMES = frozenset({"localhost", "127.0.0.1", "::1"})

EVERYWHERE: Mapping[str, str] = {"0.0.0.0": "127.0.0.1", "::": "::1"}
"""A server that listens there is reached under every address of its machine; by which one the machine itself does."""


def is_loopback(host: str) -> bool:
    """Whether only this machine reaches a server that listens there."""
    if host in LOOPBACK_NAMES:
        return True
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return False  # a name: who is meant by it others decide


def in_url(host: str) -> str:
    """The host as it stands in a URL or an endpoint: an address of version 6 in brackets."""
    return f"[{host}]" if ":" in host else host


def family(host: str) -> socket.AddressFamily:
    """In which a server of this host listens."""
    return socket.AF_INET6 if ":" in host else socket.AF_INET
