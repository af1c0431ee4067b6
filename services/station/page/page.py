"""The operator's page: hand it views, take input and buttons from it. Its server runs on a thread of its own."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import platform
import threading
from collections.abc import AsyncIterator, Sequence

import msgspec
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import HTMLResponse
from starlette.routing import Route, WebSocketRoute

from protocol.messages import Attendance, Figure, OperatorInput
from services.certificates.page import address
from services.process.addresses import in_url
from services.process.clock import Clock
from services.process.config import StationSection
from services.process.load import Loads, no_load
from services.station.live_view.description import Description
from services.station.live_view.files import Files
from services.station.page.asset_files import asset_files
from services.station.page.certificate import Renewal, check
from services.station.page.controls import is_confirmed
from services.station.page.document import document, version
from services.station.page.effects import Effects
from services.station.page.glance import Moving
from services.station.page.input import Desk
from services.station.page.link import Link
from services.station.page.login.cookie import Cookie
from services.station.page.login.door import Door
from services.station.page.login.judge import Judge
from services.station.page.login.login import Login
from services.station.page.view import Board, PageView
from services.station.press import Press
from services.station.settings import settings
from services.web.guard import Guard, policy
from services.web.server import Server
from sim.robots.robot import USUAL_CAMERAS

log = logging.getLogger(__name__)

PAGE, SETTING = "the operator's page", "[station] port"
"""What is served, and what sets where, as an error names them."""

LOOK_S = 1.0
"""Between two looks at the files of certificate and accounts."""


class Page:
    """The page and its web server, started once.

    Args:
        station: where to listen.
        robot: its name, to show.
        clock: that input and data age by.
        description: of what the live view shows.
        operator: name of an operator who gives none.
        judge: of the passwords of whoever comes; None where everybody may.
        load: says the load of this computer.
        cameras: their names.
    """

    def __init__(
        self,
        station: StationSection,
        robot: str,
        clock: Clock,
        description: Description,
        operator: str = "",
        *,
        judge: Judge | None = None,
        load: Loads = no_load,
        cameras: Sequence[str] = USUAL_CAMERAS,
    ) -> None:
        self._station = station
        self._clock = clock
        self._files = Files(description)
        self._assets = asset_files()
        settled = {action.value for action in settings(station, operator).settled}
        self._document = document(robot, self._files, cameras, settled=settled, framed=bool(station.framed_by))
        self._board = Board(clock, load)
        self.effects = Effects()
        """What entries of the history change, as far as a tab wants to see it."""
        self._address = address(station, platform.node())
        self._desk = Desk(operator)
        moving = Moving(description.joints, description.gripper)
        self._link = Link(self._desk, self._board, clock, version(), moving=moving, cameras=cameras)
        self._login: Login | None = None
        if judge is not None:
            self._login = Login(robot, judge, clock, Cookie(station.port, secure=bool(station.certificate)))
            self._login.sessions.on_end = self._link.dismiss
        self._renewal: Renewal | None = None
        self._server: Server | None = None

    @property
    def url(self) -> str:
        """Where to point a browser."""
        return f"{self._station.scheme}://{in_url(self._station.host)}:{self._station.port}"

    def start(self) -> None:
        """Listen, and return once pages are served.

        Raises:
            UnusableSetting: the certificate or its key cannot be used.
            PortInUse: something else listens there, the address is not this machine's, or the server did not come up.
        """
        check(self._station)
        self._server = self._configured()
        self._server.start()
        log.info("the operator's page is on %s", self.url)

    @property
    def call(self) -> threading.Event:
        """Set where something was pressed or let go."""
        return self._desk.call

    @property
    def jpeg_only(self) -> bool:
        """A tab is open in whose browser H.264 cannot be drawn."""
        return self._link.jpeg_only

    def show(self, view: PageView) -> None:
        """Show this from now on; a stop that was pressed here is confirmed by what the robot says."""
        self._board.put(view)
        if is_confirmed(view.safety):
            self._desk.confirm_stop()

    def take_input(self) -> OperatorInput:
        """The FULL input state; nothing is held where it is older than 150 ms, unfocused or gone."""
        return self._desk.take_input(self._clock.now_ns())

    def take_presses(self) -> list[Press]:
        """The buttons pressed since the last call."""
        return self._desk.take_presses()

    def attendance(self) -> Attendance:
        """Who is there, and where the page is; its station's name aside."""
        return msgspec.structs.replace(self._desk.attendance(), page=self._address)

    def figures(self) -> tuple[Figure, ...]:
        """Open tabs, and what was thrown away so far."""
        return (
            Figure("page_tabs", self._link.tabs, "1"),
            Figure("page_dropped", self._desk.dropped, "1"),
            Figure("page_late", self._desk.late, "1"),
        )

    def close(self) -> None:
        """Stop serving; a browser that does not answer is not waited for."""
        if self._server is None:
            return
        self._server.close()
        if self._login is not None:
            self._login.close()

    def _configured(self) -> Server:
        page = HTMLResponse(self._document)

        async def serve(request: Request) -> HTMLResponse:
            del request
            return page

        routes = [
            Route("/", serve),
            WebSocketRoute("/link", self._link.serve),
            Route("/view/{path:path}", self._files.serve),
            Route("/history/{version:int}/{entry:int}", self.effects.serve),
            Route("/assets/{path:path}", self._assets.serve),
        ]
        login, station = self._login, self._station
        app = Starlette(routes=routes if login is None else [*login.routes, *routes], lifespan=self._looking)
        server = Server(
            Guard(app if login is None else Door(app, login), station.host, policy(framed_by=station.framed_by)),
            station.host,
            station.port,
            self._clock,
            page=PAGE,
            setting=SETTING,
            certificate=station.certificate,
            key=station.key,
        )
        if server.configuration.ssl is not None:
            self._renewal = Renewal(station, server.configuration.ssl)
        return server

    @contextlib.asynccontextmanager
    async def _looking(self, app: Starlette) -> AsyncIterator[None]:
        """While it is served: look at what may change on the disk."""
        del app
        looking = asyncio.create_task(self._look())
        yield
        looking.cancel()

    async def _look(self) -> None:
        while True:
            await asyncio.sleep(LOOK_S)
            if self._renewal is not None:
                self._renewal.look()
            if self._login is not None:
                await self._login.look()
