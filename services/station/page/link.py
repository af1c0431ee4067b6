"""The page's WebSocket: the input state comes in, pictures and the tab's standing go out, the newest only."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import struct

import msgspec
from starlette.websockets import WebSocket, WebSocketDisconnect

from services.process.clock import Clock
from services.station.page.input import Desk, Held
from services.station.page.view import Board

SEND_PERIOD_S = 0.02
TICKS_PER_STANDING = 5
PICTURES_IN_FLIGHT = 2
"""As many pictures may be under way to a browser; a thin link then gets fewer pictures, not older ones."""

PICTURE_HEADER = struct.Struct("<BxxxIf")
"""Before the JPEG: camera (0 head, 1 wrist), number of the picture, its age [s]."""

TABS_AT_MOST = 8
TRY_AGAIN_LATER = 1013


class _Standing(msgspec.Struct, frozen=True):
    """What a tab is told about itself, ten times a second; its absence tells that the link is cut."""

    armed: bool
    let_go: bool


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
        self._sent = [0, 0]
        self._last: list[bytes | None] = [None, None]

    async def send_picture(self, camera: int, jpeg: bytes, age_s: float) -> None:
        """Send a picture that the tab does not have, unless too many are under way."""
        if jpeg is self._last[camera] or self._sent[camera] - self.drawn[camera] >= PICTURES_IN_FLIGHT:
            return
        self._last[camera] = jpeg
        self._sent[camera] += 1
        await self.socket.send_bytes(PICTURE_HEADER.pack(camera, self._sent[camera], age_s) + jpeg)


class Link:
    """The endpoint to which every tab connects.

    Args:
        desk: that the input goes to.
        board: that the pictures come from.
        clock: that the input ages by.
    """

    def __init__(self, desk: Desk, board: Board, clock: Clock) -> None:
        self._desk = desk
        self._board = board
        self._clock = clock
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
        self._desk.join(tab.number, self._clock.now_ns())
        sender = asyncio.create_task(self._send(tab))
        try:
            await self._receive(tab)
        finally:
            self._desk.leave(tab.number)
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
                shown = self._board.newest()
                for camera, picture in enumerate((shown.view.head, shown.view.wrist)):
                    if picture is not None:
                        await tab.send_picture(camera, picture.jpeg, picture.age_s + shown.elapsed_s)
                if tick % TICKS_PER_STANDING == 0:
                    standing = self._desk.standing(tab.number, self._clock.now_ns())
                    message = _Standing(standing.armed, standing.let_go)
                    await tab.socket.send_text(msgspec.json.encode(message).decode())
                await asyncio.sleep(SEND_PERIOD_S)
