"""A server that ends lets go of every connection, of browsers too that do not answer."""

import asyncio
import contextlib
import gc
import socket
import threading

import pytest

from services.process.clock import SystemClock
from services.web.server import Server
from tests.ports import free_port
from tests.system.harness import eventually


async def never(scope, receive, send):
    """Takes every request, and answers none."""
    if scope["type"] == "lifespan":
        while (message := await receive())["type"] != "lifespan.shutdown":
            await send({"type": f"{message['type']}.complete"})
        await send({"type": "lifespan.shutdown.complete"})
        return
    try:
        await asyncio.sleep(600.0)
    except asyncio.CancelledError:
        await asyncio.sleep(2.0)  # whoever is told to end finishes something first


@pytest.mark.parametrize(
    "request_", [b"", b"GET / HT", b"GET / HTTP/1.1\r\nHost: here\r\n\r\n"], ids=["", "half", "whole"]
)
def test_whoever_is_still_connected_is_let_go_of(request_):
    port = free_port()
    server = Server(never, "127.0.0.1", port, SystemClock(), page="page", setting="port")
    server.start()
    clients = [socket.create_connection(("127.0.0.1", port)) for _ in range(4)]
    for client in clients:
        client.sendall(request_)
        client.settimeout(20.0)
    server.close()
    eventually(lambda: not [one for one in threading.enumerate() if one.name == "page"], 20.0, "the thread has ended")
    gc.collect()  # a connection that nobody has closed is told of here
    for client in clients:
        with contextlib.suppress(ConnectionResetError):
            assert client.recv(65536) == b""
        client.close()
