"""Logging in and out: what browsers ask for, and who they are by then."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from urllib.parse import urlencode

from starlette.requests import HTTPConnection, Request
from starlette.responses import HTMLResponse, RedirectResponse, Response
from starlette.routing import Route

from protocol.messages import Role
from services.accounts.account import Account
from services.process.clock import Clock
from services.station.page.login.cookie import Cookie
from services.station.page.login.document import document
from services.station.page.login.form import LONGEST_NAME, Form, NoForm, read
from services.station.page.login.judge import Busy, Judge
from services.station.page.login.sessions import Session, Sessions
from services.station.page.login.waits import Waits
from services.station.words.table import say

LOGIN, LOGOUT = "/login", "/logout"

AGAIN_S = 1
"""After so long somebody may try again for whom there was no time [s]."""

_ROLES = frozenset(role.value for role in Role)
_SAID = ("out", "ended")
"""Why somebody comes to the log-in, as its address has it: they logged out, or their session has ended."""

log = logging.getLogger(__name__)


class Login:
    """Who is logged in.

    Args:
        robot: its name, to show.
        judge: of passwords.
        clock: by which sessions age and people wait.
        cookie: of the page.

    Attributes:
        sessions: of everybody who is.
    """

    def __init__(self, robot: str, judge: Judge, clock: Clock, cookie: Cookie) -> None:
        self.sessions = Sessions(clock)
        self.routes = [
            Route(LOGIN, self._show, methods=["GET"]),
            Route(LOGIN, self._enter, methods=["POST"]),
            Route(LOGOUT, self._leave, methods=["POST"]),
        ]
        self._robot = robot
        self._judge = judge
        self._cookie = cookie
        self._waits = Waits(clock)
        self._told = ""

    def session(self, connection: HTTPConnection) -> Session | None:
        """Of whoever a request or connection comes from; None where they have not logged in."""
        return self.sessions.find(self._cookie.token(connection))

    async def look(self) -> None:
        """Whoever's account has changed, or who did nothing for long, is logged out."""
        if await self._judge.refresh():
            self._follow()
        self.sessions.expire()

    def close(self) -> None:
        """Let nobody in any more."""
        self._judge.close()

    async def _show(self, request: Request) -> Response:
        if self.session(request) is not None:
            return _to("/", request)
        said = request.query_params.get("said", "")
        return self._page(request, say(f"log_in.{said}") if said in _SAID else "")

    async def _enter(self, request: Request) -> Response:
        try:
            form = await read(request)
            async with self._judge.turn():
                return await self._answer(request, form)
        except NoForm:
            return self._page(request, say("log_in.no_form"), 400)
        except Busy:
            return self._page(request, say("log_in.wait", seconds=AGAIN_S), 503, AGAIN_S)

    async def _answer(self, request: Request, form: Form) -> Response:
        address = request.client.host if request.client is not None else ""
        left_s = self._waits.left_s(form.name, address)
        if left_s > 0:
            return self._page(request, say("log_in.wait", seconds=left_s), 429, left_s, form.name)
        account = await self._judge.judged(form.name, form.password)
        self._follow()
        if self._judge.fault:
            return self._page(request, say("log_in.broken"), 503, 0, form.name)
        if account is None:
            self._waits.failed(form.name, address)
            known = self._judge.accounts.find(form.name)
            log.warning("a log-in of %s from %s failed", known.name if known else "nobody who has an account", address)
            return self._page(request, say("log_in.wrong"), 403, 0, form.name)
        self._waits.succeeded(form.name, address)
        return self._welcome(request, account, address)

    def _welcome(self, request: Request, account: Account, address: str) -> Response:
        before = self.session(request)
        if before is not None:
            self.sessions.end(before)
        log.info("%s has logged in from %s, as %s", account.name, address, account.role.value)
        response = _to("/", request)
        self._cookie.give(response, self.sessions.open(account))
        return response

    async def _leave(self, request: Request) -> Response:
        session = self.session(request)
        if session is not None:
            self.sessions.end(session)
            log.info("%s has logged out", session.account.name)
        response = _to(LOGIN, request, said="out")
        self._cookie.take(response)
        return response

    def _follow(self) -> None:
        """Sessions are those of the accounts as they are now."""
        fault = self._judge.fault
        if fault and fault != self._told:
            log.error("%s", fault)
        self._told = fault
        self.sessions.follow(self._judge.accounts)

    def _page(self, request: Request, notice: str, status: int = 200, again_s: int = 0, name: str = "") -> Response:
        shown = name or _name(request)
        html = document(self._robot, way_in(request), shown, notice)
        headers = {"Cache-Control": "no-store", **({"Retry-After": str(again_s)} if again_s else {})}
        return HTMLResponse(html, status, headers)


def way_in(connection: HTTPConnection) -> str:
    """Where somebody logs in who came with a name and a role in the address: both go along."""
    return _address(LOGIN, connection, {"name": _name(connection)})


def page_for(connection: HTTPConnection) -> str:
    """The page for somebody who came to it in this way."""
    return _address("/", connection, {"name": _name(connection)})


def _to(path: str, connection: HTTPConnection, **more: str) -> RedirectResponse:
    return RedirectResponse(_address(path, connection, more), status_code=303, headers={"Cache-Control": "no-store"})


def _name(connection: HTTPConnection) -> str:
    return connection.query_params.get("name", "")[:LONGEST_NAME]


def _address(path: str, connection: HTTPConnection, more: Mapping[str, str]) -> str:
    role = connection.query_params.get("role", "")
    kept = {**more, "role": role if role in _ROLES else ""}
    query = urlencode({key: value for key, value in kept.items() if value})
    return f"{path}?{query}" if query else path
