"""A web server on a thread of its own."""

from __future__ import annotations

import asyncio
import socket
import threading

import uvicorn
from starlette.types import ASGIApp

from services.process.addresses import family
from services.process.clock import Clock
from services.process.exceptions import PortInUse
from services.web.web_socket import WebSocketProtocol

START_WITHIN_S = 60.0
STOP_POLITELY_S = 0.7
STOP_AT_ONCE_S = 0.3


class Server:
    """Started once.

    Args:
        app: that is served.
        host: address that it listens on.
        port: of it.
        clock: by which its start is waited for.
        page: what is served, as an error names it.
        setting: that says where, likewise.
        certificate: file of the TLS certificate, PEM; empty for plain HTTP.
        key: file of its private key; empty where it stands in the certificate's file.

    Attributes:
        configuration: of uvicorn, loaded.
    """

    def __init__(
        self,
        app: ASGIApp,
        host: str,
        port: int,
        clock: Clock,
        *,
        page: str,
        setting: str,
        certificate: str = "",
        key: str = "",
    ) -> None:
        self._host, self._port, self._clock = host, port, clock
        self._page, self._setting = page, setting
        self.configuration = uvicorn.Config(
            app,
            proxy_headers=False,  # whoever comes is who comes, whatever they say of others
            log_config=None,
            access_log=False,
            lifespan="on",
            loop="asyncio",
            http="h11",
            ws=WebSocketProtocol,
            ws_max_size=65_536,
            ws_per_message_deflate=False,
            timeout_graceful_shutdown=1,
            ssl_certfile=certificate or None,
            ssl_keyfile=key or None,
        )
        self.configuration.load()
        self._server = uvicorn.Server(self.configuration)
        self._thread: threading.Thread | None = None

    def start(self) -> None:
        """Listen, and return once pages are served.

        Raises:
            PortInUse: something else listens there, the address is not this machine's, or the server did not come up.
        """
        listener = self._listen()
        self._thread = threading.Thread(target=self._serve, args=(listener,), name="page", daemon=True)
        self._thread.start()
        deadline_ns = self._clock.now_ns() + round(START_WITHIN_S * 1e9)
        while not self._server.started:
            if not self._thread.is_alive() or self._clock.now_ns() > deadline_ns:
                raise PortInUse(self._page, self._host, self._port, self._setting, "the server did not start")
            self._thread.join(0.02)

    def close(self) -> None:
        """Stop serving; a browser that does not answer is not waited for."""
        if self._thread is None:
            return
        self._server.should_exit = True
        self._thread.join(STOP_POLITELY_S)
        self._server.force_exit = True
        self._thread.join(STOP_AT_ONCE_S)

    def _listen(self) -> socket.socket:
        try:
            listener = socket.create_server((self._host, self._port), family=family(self._host))
        except OSError as error:
            raise PortInUse(self._page, self._host, self._port, self._setting, error.strerror or "") from None
        # Every connection has it from here; asyncio sets it only on sockets that were made by the protocol's number.
        # What follows upon something small waits otherwise until that was acknowledged, which is put off for 40 ms.
        listener.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return listener

    def _serve(self, listener: socket.socket) -> None:
        with listener:
            asyncio.run(self._served(listener))

    async def _served(self, listener: socket.socket) -> None:
        await self._server.serve(sockets=[listener])
        # Whoever has not answered by now is let go of: the loop would end with the connection open.
        for connection in list(self._server.server_state.connections):
            connection.transport.abort()
        await asyncio.sleep(0.0)
