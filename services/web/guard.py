"""Keeps other web pages away from one that acts: a foreign site in the same browser must not command."""

from __future__ import annotations

from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from services.process.addresses import LOOPBACK_NAMES, is_loopback


def policy(frames: str = "", framed_by: str = "") -> str:
    """What a page may ask for: nobody but its own server, and it is nobody's part.

    Args:
        frames: origin of a page that it shows in a frame; empty for none.
        framed_by: origin of the one page that may show it in a frame; empty for none.
    """
    nobody = "'none'"
    return "; ".join(
        (
            "default-src 'self'",
            "connect-src 'self' ws: wss:",  # not every browser counts the own server's WebSocket as 'self'
            *([f"frame-src {frames}"] if frames else []),
            f"frame-ancestors {framed_by or nobody}",
            "form-action 'self'",
            "object-src 'none'",
            "base-uri 'none'",
        )
    )


_LOOKS = frozenset(("GET", "HEAD"))
"""What changes nothing, whichever page it comes from."""


class Guard:
    """Middleware: refuses foreign host names and foreign origins, and tells the browser to ask no other server.

    Args:
        app: what it stands before.
        host: that the server listens on; on a loopback address only loopback names may ask, so that no foreign name
            can be pointed here (DNS rebinding).
        content: what its pages may ask for.
    """

    def __init__(self, app: ASGIApp, host: str, content: str) -> None:
        self._app = app
        self._content = content
        self._names = LOOPBACK_NAMES | {host} if is_loopback(host) else None

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve, or refuse, one request or connection."""
        if scope["type"] not in {"http", "websocket"}:
            await self._app(scope, receive, send)
            return
        acts = scope["type"] == "websocket" or scope["method"] not in _LOOKS
        if not self._welcome(Headers(scope=scope), acts):
            refusal = PlainTextResponse("Open the page under the address that it is served on.", status_code=403)
            await refusal(scope, receive, send)
            return

        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                headers["Content-Security-Policy"] = self._content
                headers["X-Content-Type-Options"] = "nosniff"
                # Nothing goes to others; with less than this a browser sends a form without its origin.
                headers["Referrer-Policy"] = "same-origin"
            await send(message)

        await self._app(scope, receive, send_with_headers)

    def _welcome(self, headers: Headers, acts: bool) -> bool:
        host = headers.get("host", "")
        try:
            if self._names is not None and urlsplit(f"//{host}").hostname not in self._names:
                return False
            return not acts or urlsplit(headers.get("origin", "")).netloc == host
        except ValueError:  # what no browser sends: brackets around no address
            return False
