"""A router's links are given up by the kernel when their lease is over, so that closing one holds up no other."""

import os
import socket
from pathlib import Path

import pytest

from services.bus.zenoh import open_router
from services.bus.zenoh.transport import LEASE_MS
from tests.ports import free_port

pytestmark = pytest.mark.zenoh


def listeners():
    """Descriptors of this process on which somebody listens."""
    for file in list(Path("/proc/self/fd").iterdir()):
        try:
            with socket.fromfd(int(file.name), socket.AF_INET, socket.SOCK_STREAM) as one:
                if one.getsockopt(socket.SOL_SOCKET, socket.SO_ACCEPTCONN):
                    yield one
        except OSError:
            continue


def test_opening_a_router_leaves_nothing_behind_of_what_is_open(tmp_path):
    with (tmp_path / "file").open("w") as file:
        open_router(f"tcp/127.0.0.1:{free_port()}").close()
        links = [os.path.realpath(one) for one in Path("/proc/self/fd").iterdir()]
        assert links.count(os.path.realpath(file.name)) == 1


def test_what_a_router_accepts_is_given_up_with_the_lease():
    port = free_port()
    router = open_router(f"tcp/127.0.0.1:{port}")
    try:
        times = [
            one.getsockopt(socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT)
            for one in listeners()
            if one.getsockname()[1] == port
        ]
    finally:
        router.close()
    assert times == [LEASE_MS]
