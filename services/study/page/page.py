"""The study's web server: a page for each participant, and the console. It runs on a thread of its own."""

from __future__ import annotations

import hmac
from urllib.parse import urlsplit

from starlette.applications import Starlette
from starlette.requests import HTTPConnection, Request
from starlette.responses import HTMLResponse, PlainTextResponse, RedirectResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket

from services.process.addresses import in_url
from services.process.clock import Clock
from services.study.page.desk import Desk
from services.study.page.document import CONSOLE, NUMBER, PARTICIPANT, asset_files, document, version
from services.study.page.link import Link
from services.web.guard import Guard, policy
from services.web.server import Server

PAGE, SETTING = "the study's page", "--port"
"""What is served, and what sets where, as an error names them."""

_CLOSED = 4403


class StudyPage:
    """The pages and their web server, started once.

    Args:
        desk: of the study.
        clock: by which the server's start is waited for.
        host: address to listen on.
        port: of it.
        key: that the console's address has to carry; empty where everybody who reaches the server may experiment.
    """

    def __init__(self, desk: Desk, clock: Clock, *, host: str = "127.0.0.1", port: int = 8090, key: str = "") -> None:
        self._desk = desk
        self._key = key
        self._url = f"http://{in_url(host)}:{port}"
        self._link = Link(desk, version())
        app = Starlette(
            routes=[
                Route("/", self._number),
                Route("/participant/{number:int}", self._participant),
                Route("/console", self._console),
                Route("/assets/{path:path}", asset_files().serve),
                WebSocketRoute("/link/console", self._console_link),
                WebSocketRoute("/link/{number:int}", self._link.participant),
            ]
        )
        station = urlsplit(desk.trials.url)
        guarded = Guard(app, host, policy(frames=f"{station.scheme}://{station.netloc}"))
        self._server = Server(guarded, host, port, clock, page=PAGE, setting=SETTING)

    @property
    def url(self) -> str:
        """Where participants say their number."""
        return f"{self._url}/"

    @property
    def console_url(self) -> str:
        """Where to point the experimenter's browser."""
        return f"{self._url}/console{f'?key={self._key}' if self._key else ''}"

    def participant_url(self, number: int) -> str:
        """Where to point a participant's browser."""
        return f"{self._url}/participant/{number}"

    def start(self) -> None:
        """Listen, and return once pages are served.

        Raises:
            PortInUse: something else listens there, the address is not this machine's, or the server did not come up.
        """
        self._server.start()

    def close(self) -> None:
        """Stop serving."""
        self._server.close()

    async def _number(self, request: Request) -> Response:
        """Asks who is there; whoever says a number is led to their page."""
        asked = request.query_params.get("number", "")
        if not asked:
            return HTMLResponse(document(NUMBER, notice=""))
        with self._desk.lock:
            known = {str(number) for number in self._desk.conductor.participants()}
        if asked not in known:
            notice = f"There is no participant {asked[:20]}: the experimenter enrols them first."
            return HTMLResponse(document(NUMBER, notice=notice), 404)
        return RedirectResponse(f"/participant/{asked}", status_code=303)

    async def _participant(self, request: Request) -> Response:
        number = request.path_params["number"]
        with self._desk.lock:
            known = number in self._desk.conductor.participants()
        if not known:
            return RedirectResponse(f"/?number={number}", status_code=303)
        return HTMLResponse(document(PARTICIPANT, number=str(number)))

    async def _console(self, request: Request) -> Response:
        if not self._may_experiment(request):
            return PlainTextResponse("Open the console under the address that the command has told.", status_code=403)
        return HTMLResponse(document(CONSOLE))

    async def _console_link(self, socket: WebSocket) -> None:
        if not self._may_experiment(socket):
            await socket.close(_CLOSED)
            return
        await self._link.console(socket)

    def _may_experiment(self, connection: HTTPConnection) -> bool:
        said = connection.query_params.get("key", "")
        return not self._key or hmac.compare_digest(said.encode(), self._key.encode())
