"""The page's WebSocket: the input state comes in; pictures and what the tab shows go out, the newest only."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import struct

import msgspec
from starlette.websockets import WebSocket, WebSocketDisconnect

from services.process.clock import Clock
from services.station.page.input import Desk
from services.station.page.layout import values
from services.station.page.said import Held
from services.station.page.values import Sent, Values
from services.station.page.view import Board

SEND_PERIOD_S = 0.02
TICKS_PER_NEWS = 5
PICTURES_IN_FLIGHT = 2
"""As many pictures may be under way to a browser; a thin link then gets fewer pictures, not older ones."""

PICTURE_HEADER = struct.Struct("<BxxxIf")
"""Before the JPEG: camera (0 head, 1 wrist), number of the picture, its age [s]."""

TABS_AT_MOST = 8
TRY_AGAIN_LATER = 1013


class _News(msgspec.Struct, frozen=True):
    """What a tab is told ten times a second; its absence tells that the link is cut.

    Attributes:
        version: of the page that is served now.
        armed: the tab has the seat.
        let_go: its keys count once they were let go.
        accepted: numbers of presses that were passed on.
        refused: numbers of presses that were not.
        values: to show, as far as they are new.
    """

    version: str
    armed: bool
    let_go: bool
    accepted: tuple[int, ...]
    refused: tuple[int, ...]
    values: Values


class _Tab:
    """One browser tab.

    Args:
        number: no other tab of this process has it.
        socket: accepted.
    """

    def __init__(self, number: int, socket: WebSocket) -> None:
        self.number = number
        self.socket = socket
        self.drawn = (0, 0)
        self.sent = Sent()
        self._pictures = [0, 0]
        self._last: list[bytes | None] = [None, None]

    async def send_picture(self, camera: int, jpeg: bytes, age_s: float) -> None:
        """Send a picture that the tab does not have, unless too many are under way."""
        if jpeg is self._last[camera] or self._pictures[camera] - self.drawn[camera] >= PICTURES_IN_FLIGHT:
            return
        self._last[camera] = jpeg
        self._pictures[camera] += 1
        await self.socket.send_bytes(PICTURE_HEADER.pack(camera, self._pictures[camera], age_s) + jpeg)


class Link:
    """The endpoint to which every tab connects.

    Args:
        desk: that the input goes to.
        board: that the pictures come from.
        clock: that the input ages by.
        version: of the page's files.
    """

    def __init__(self, desk: Desk, board: Board, clock: Clock, version: str) -> None:
        self._desk = desk
        self._board = board
        self._clock = clock
        self._version = version
        self._numbers = itertools.count(1)
        self.tabs = 0

    async def serve(self, socket: WebSocket) -> None:
        """Serve one tab until it goes."""
        await socket.accept()
        if self.tabs >= TABS_AT_MOST:
            await socket.close(TRY_AGAIN_LATER, f"{TABS_AT_MOST} tabs are open already")
            return
        tab = _Tab(next(self._numbers), socket)
        self.tabs += 1
        sender = asyncio.create_task(self._send(tab))
        try:
            await self._receive(tab)
        finally:
            self._desk.leave(tab.number, self._clock.now_ns())
            self.tabs -= 1
            sender.cancel()

    async def _receive(self, tab: _Tab) -> None:
        while (frame := await tab.socket.receive())["type"] != "websocket.disconnect":
            payload = frame.get("text") or frame.get("bytes") or b""
            message = self._desk.receive(tab.number, payload, self._clock.now_ns())
            if isinstance(message, Held):
                tab.drawn = message.drawn

    async def _send(self, tab: _Tab) -> None:
        # A tab that goes while something is sent is no fault: the receiving side notices and ends this task.
        with contextlib.suppress(WebSocketDisconnect, RuntimeError):
            for tick in itertools.count():
                if tick % TICKS_PER_NEWS == 0:
                    await tab.socket.send_text(self._news(tab))
                shown = self._board.newest()
                for camera, picture in enumerate((shown.view.head, shown.view.wrist)):
                    if picture is not None:
                        await tab.send_picture(camera, picture.jpeg, picture.age_s + shown.elapsed_s)
                await asyncio.sleep(SEND_PERIOD_S)

    def _news(self, tab: _Tab) -> str:
        standing = self._desk.standing(tab.number, self._clock.now_ns())
        shown = self._board.newest()
        news = _News(
            self._version,
            standing.armed,
            standing.let_go,
            standing.accepted,
            standing.refused,
            tab.sent.news(values(shown, standing)),
        )
        return msgspec.json.encode(news).decode()
