"""The cookie by which a browser shows its session."""

from __future__ import annotations

from starlette.requests import HTTPConnection
from starlette.responses import Response

LONGEST = 128
"""Characters of a token, at most."""


class Cookie:
    """The session's cookie of one page.

    Browsers keep no two servers of a host apart by their ports: each page has a name of its own for it.

    Args:
        port: of the page.
        secure: it is served over HTTPS, and the cookie goes nowhere else.
    """

    def __init__(self, port: int, *, secure: bool) -> None:
        self._secure = secure
        # No other server of the domain can set one of this kind (RFC 6265bis, section 4.1.3.2).
        self._name = f"{'__Host-' if secure else ''}retouch-{port}"

    def token(self, connection: HTTPConnection) -> str:
        """What the browser shows; empty where it shows nothing."""
        token = connection.cookies.get(self._name, "")
        return token if len(token) <= LONGEST else ""

    def give(self, response: Response, token: str) -> None:
        """Let the browser keep a token, until it is closed."""
        response.set_cookie(self._name, token, path="/", secure=self._secure, httponly=True, samesite="strict")

    def take(self, response: Response) -> None:
        """Let the browser forget it."""
        response.delete_cookie(self._name, path="/", secure=self._secure, httponly=True, samesite="strict")
