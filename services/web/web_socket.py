"""The WebSocket protocol of the page's server: uvicorn's, but for its goodbyes."""

from __future__ import annotations

import asyncio
import contextlib
import socket

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol


class WebSocketProtocol(WebSocketsSansIOProtocol):
    """Says goodbye once.

    A browser that said goodbye may hold its connection for a while, over TLS for as long as it likes. uvicorn says
    goodbye to it again when the server ends, which the protocol forbids (RFC 6455, section 5.5.1), and ends in the
    middle: other tabs are not told, and what was to be waited for is not.
    """

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """A browser has come."""
        super().connection_made(transport)
        self._socket = transport.get_extra_info("socket")

    def shutdown(self) -> None:
        """The server ends."""
        if not self.transport.is_closing():
            super().shutdown()
            return
        # A transport over TLS that is closing cannot be aborted any more.
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)
