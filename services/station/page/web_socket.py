"""The WebSocket protocol of the page's server: uvicorn's, but for its goodbyes."""

from __future__ import annotations

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol


class WebSocketProtocol(WebSocketsSansIOProtocol):
    """Says goodbye once.

    A browser that said goodbye may hold its connection for a while, over TLS for as long as it likes. uvicorn says
    goodbye to it again when the server ends, which the protocol forbids (RFC 6455, section 5.5.1), and ends in the
    middle: other tabs are not told, and what was to be waited for is not.
    """

    def shutdown(self) -> None:
        """The server ends."""
        if not self.transport.is_closing():
            super().shutdown()
