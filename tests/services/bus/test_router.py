"""A router's links are given up by the kernel when their lease is over, so that closing one holds up no other."""

import os
import socket
from pathlib import Path

import pytest

from services.bus.zenoh import close_session, open_router
from services.bus.zenoh.sessions import LEASE_MS

pytestmark = pytest.mark.zenoh


def sockets():
    """Copies of all TCP sockets of this process."""
    for file in list(Path("/proc/self/fd").iterdir()):
        try:
            copy = socket.socket(fileno=os.dup(int(file.name)))
        except OSError:
            continue
        with copy:
            if copy.family == socket.AF_INET and copy.type == socket.SOCK_STREAM:
                yield copy


def test_what_a_router_accepts_is_given_up_with_the_lease():
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port = probe.getsockname()[1]
    router = open_router(f"tcp/127.0.0.1:{port}")
    try:
        times = [
            one.getsockopt(socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT)
            for one in sockets()
            if one.getsockname()[1] == port
        ]
        assert times == [LEASE_MS]
    finally:
        close_session(router)
