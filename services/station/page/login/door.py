"""Lets through who has logged in; everybody else gets to see the log-in, and nothing behind it."""

from __future__ import annotations

from starlette.requests import HTTPConnection
from starlette.responses import PlainTextResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocket

from services.station.page.asset_files import ICON_ADDRESS, LOGIN_STYLE_ADDRESS, SYMBOLS_ADDRESS
from services.station.page.login.login import LOGIN, Login, page_for, way_in

SESSION = "retouch.session"
"""Of a connection's scope: the session of whoever it comes from."""

NOT_LOGGED_IN = 4401
"""With which a link ends: the page's script goes to the log-in then, and dials no more."""

PUBLIC = frozenset((LOGIN, LOGIN_STYLE_ADDRESS, ICON_ADDRESS, SYMBOLS_ADDRESS))
"""What the log-in itself consists of."""


class Door:
    """Middleware.

    Args:
        app: what it stands before.
        login: knows who has logged in.
    """

    def __init__(self, app: ASGIApp, login: Login) -> None:
        self._app = app
        self._login = login

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve, or refuse, one request or connection."""
        if scope["type"] not in {"http", "websocket"}:
            await self._app(scope, receive, send)
            return
        session = self._login.session(HTTPConnection(scope))
        if session is not None or (scope["type"] == "http" and scope["path"] in PUBLIC):
            await self._app({**scope, SESSION: session}, receive, send)
        elif scope["type"] == "websocket":
            # Accepted first: of one that is refused at once a script learns no reason.
            socket = WebSocket(scope, receive, send)
            await socket.accept()
            await socket.close(NOT_LOGGED_IN)
        else:
            await _refusal(HTTPConnection(scope))(scope, receive, send)


def _refusal(connection: HTTPConnection) -> Response:
    if connection.url.path != "/":
        return PlainTextResponse("Log in first.", status_code=401)
    if connection.headers.get("sec-fetch-site") == "cross-site":
        # From the page of a robot elsewhere: a browser shows no cookie then, but does where it asks by itself.
        return PlainTextResponse("", headers={"Refresh": f"0; url={page_for(connection)}", "Cache-Control": "no-store"})
    return RedirectResponse(way_in(connection), status_code=303)
