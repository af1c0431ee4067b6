"""The page's WebSocket: the input state comes in; pictures and what the tab shows go out, the newest only."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import struct
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

import msgspec
from starlette.websockets import WebSocket, WebSocketDisconnect

from services.bus.picture_stream import Group
from services.process.clock import Clock
from services.station.live_view.drawing import Point, has_moved, packed
from services.station.page.glance import Glances, Moving
from services.station.page.input import Desk
from services.station.page.layout import own
from services.station.page.login.door import NOT_LOGGED_IN, SESSION
from services.station.page.login.sessions import Session
from services.station.page.said import Held, Pressed
from services.station.page.values import Sent, Values
from services.station.page.view import Board, Picture

LOOK_PERIOD_NS = 20_000_000
"""Between two looks at what is new: at the same times for all tabs, so that one look and one waking serve them all."""

NEWS_PERIOD_NS = 100_000_000
MOMENT_PERIOD_NS = round(1e9 / 30.0)
FRAMES_IN_FLIGHT = 2
"""As many pictures may be under way to a browser, and moments, and clouds; a thin link, or a browser that draws slowly,
then gets fewer of them, not older ones."""

FRAME_HEADER = struct.Struct("<BBxxIf")
"""Before a picture, a moment or a cloud: what it is (0 moment, 1 point cloud, from 2 on the cameras' pictures in
their order on the page), how it is coded (0 a JPEG file, or what is no picture, 1 H.264 that goes on, 2 H.264 from a
key picture on), its number, its age [s]."""

MOMENT, CLOUD, FIRST_CAMERA = range(3)
WHOLE, GOES_ON, FROM_KEY = range(3)

LENGTH = struct.Struct("<I")
"""Before each picture of H.264; all but the last are only there because that one needs them [byte]."""

TABS_AT_MOST = 8
TRY_AGAIN_LATER = 1013

GOODBYE_S = 1.0
"""For so long a tab is told that it is turned away [s]."""


class _News(msgspec.Struct, frozen=True):
    """What a tab is told ten times a second; its absence tells that the link is cut.

    Attributes:
        version: of the page that is served now.
        armed: the tab has the seat.
        let_go: its keys count once they were let go.
        accepted: numbers of presses that were passed on.
        refused: numbers of presses that were not.
        echo: the tab's clock when it sent its newest state [ms], and how long that has been here [ms]: what else has
            passed by then is the link's.
        values: to show, as far as they are new.
        drawing: parts of what the live view draws, as far as they are new.
        history: the skill's history, where it is new.
    """

    version: str
    armed: bool
    let_go: bool
    accepted: tuple[int, ...]
    refused: tuple[int, ...]
    echo: tuple[float, float]
    values: Values
    drawing: Mapping[str, Any]
    history: Mapping[str, Any]


class _Tab:
    """One browser tab.

    Args:
        number: no other tab of this process has it.
        socket: accepted.
        session: of whoever is there; None where nobody has to log in.

    Attributes:
        dismissed: set where the session has ended.
        wants_cloud: it shows the point cloud.
        jpeg_only: its browser draws no H.264.
        heard: the tab's clock when it sent its newest state [ms], and ours when that came [ns].
    """

    def __init__(self, number: int, socket: WebSocket, session: Session | None) -> None:
        self.number = number
        self.socket = socket
        self.session = session
        self.dismissed = asyncio.Event()
        self.drawn: tuple[int, ...] = ()
        self.wants_cloud = self.jpeg_only = False
        self.heard = (0.0, 0)
        self.values: Sent[str | bool] = Sent()
        self.drawing: Sent[Any] = Sent()
        self.history: Sent[Any] = Sent()
        self._numbers: Counter[int] = Counter()
        self._last: dict[int, bytes] = {}
        self._decoded: dict[int, Group] = {}
        self._moment: Point = ()

    async def send_picture(self, kind: int, picture: Picture | None, elapsed_s: float) -> None:
        """Send a picture that the tab does not have; one that looks the same is a newer one all the same."""
        if picture is None or picture.data is self._last.get(kind):
            return
        if picture.group is not None:
            await self._send_group(kind, picture.data, picture.group, picture.age_s + elapsed_s)
        elif await self._send(kind, picture.data, picture.age_s + elapsed_s):
            self._last[kind] = picture.data

    async def _send_group(self, kind: int, newest: bytes, group: Group, age_s: float) -> None:
        """Send a picture with all that the tab does not have of what it needs, where its browser can draw it."""
        if self.jpeg_only:
            return
        missing = group.after(self._decoded.get(kind))
        content = b"".join(LENGTH.pack(len(picture)) + picture for picture in missing)
        coding = FROM_KEY if len(missing) == len(group.pictures) else GOES_ON
        if await self._send(kind, content, age_s, coding):
            self._last[kind], self._decoded[kind] = newest, group

    async def send_moment(self, values: Point, age_s: float) -> None:
        """Send what moves, where it has moved."""
        if has_moved(values, self._moment) and await self._send(MOMENT, packed(values), age_s):
            self._moment = values

    async def _send(self, kind: int, content: bytes, age_s: float, coding: int = WHOLE) -> bool:
        """Whether it was sent: not where too many are under way."""
        drawn = self.drawn[kind] if kind < len(self.drawn) else 0
        if self._numbers[kind] - drawn >= FRAMES_IN_FLIGHT:
            return False
        self._numbers[kind] += 1
        await self.socket.send_bytes(FRAME_HEADER.pack(kind, coding, self._numbers[kind], age_s) + content)
        return True


class Link:
    """The endpoint to which every tab connects.

    Args:
        desk: that the input goes to.
        board: that the pictures come from.
        clock: that the input ages by.
        version: of the page's files.
        moving: what moves in the live view.
        cameras: their names, in their order on the page.
    """

    def __init__(
        self,
        desk: Desk,
        board: Board,
        clock: Clock,
        version: str,
        *,
        moving: Moving,
        cameras: Sequence[str],
    ) -> None:
        self._cameras = tuple(cameras)
        self._desk = desk
        self._glances = Glances(board, moving, LOOK_PERIOD_NS)
        self._clock = clock
        self._version = version
        self._numbers = itertools.count(1)
        self._tabs: set[_Tab] = set()

    @property
    def jpeg_only(self) -> bool:
        """A tab is open in whose browser H.264 cannot be drawn."""
        return any(tab.jpeg_only for tab in tuple(self._tabs))

    @property
    def tabs(self) -> int:
        """How many are open."""
        return len(self._tabs)

    async def serve(self, socket: WebSocket) -> None:
        """Serve one tab until it goes."""
        await socket.accept()
        if self.tabs >= TABS_AT_MOST:
            await socket.close(TRY_AGAIN_LATER, f"{TABS_AT_MOST} tabs are open already")
            return
        tab = _Tab(next(self._numbers), socket, socket.scope.get(SESSION))
        self._tabs.add(tab)
        sender = asyncio.create_task(self._send(tab))
        receiver = asyncio.create_task(self._receive(tab))
        dismissed = asyncio.create_task(tab.dismissed.wait())
        try:
            await asyncio.wait((receiver, dismissed), return_when=asyncio.FIRST_COMPLETED)
        finally:
            self._desk.leave(tab.number, self._clock.now_ns())
            self._tabs.discard(tab)
            for task in (sender, receiver, dismissed):
                task.cancel()
        if tab.dismissed.is_set():
            await _turn_away(socket)
        else:
            receiver.result()

    def dismiss(self, session: Session) -> None:
        """A session has ended: nothing of its tabs counts from now on, and they are told."""
        for tab in self._tabs:
            if tab.session is session:
                self._desk.dismiss(tab.number, self._clock.now_ns())
                tab.dismissed.set()

    async def _receive(self, tab: _Tab) -> None:
        session = tab.session
        while (frame := await tab.socket.receive())["type"] != "websocket.disconnect":
            if session is not None and session.ended:
                return
            payload = frame.get("text") or frame.get("bytes") or b""
            now_ns = self._clock.now_ns()
            message = self._desk.receive(tab.number, payload, now_ns, session.account if session is not None else None)
            if session is not None and (isinstance(message, Pressed) or (isinstance(message, Held) and message.keys)):
                session.used_ns = now_ns
            if isinstance(message, Held):
                tab.drawn, tab.wants_cloud, tab.jpeg_only = message.drawn, message.cloud, message.jpeg_only
                tab.heard = (message.stamp_ms, now_ns)

    async def _send(self, tab: _Tab) -> None:
        # A tab that goes while something is sent is no fault: the receiving side notices and ends this task.
        with contextlib.suppress(WebSocketDisconnect, RuntimeError):
            before_ns = 0
            while True:
                due_ns = self._clock.now_ns()
                if _is_another(NEWS_PERIOD_NS, due_ns, before_ns):
                    await tab.socket.send_text(self._news(tab, due_ns))
                now_ns = self._clock.now_ns()  # what goes over a thin link waits until it is through
                glance = self._glances.at(now_ns)
                view, elapsed_s = glance.shown.view, glance.elapsed_s(now_ns)
                for kind, camera in enumerate(self._cameras, FIRST_CAMERA):
                    await tab.send_picture(kind, view.cameras.get(camera), elapsed_s)
                if _is_another(MOMENT_PERIOD_NS, due_ns, before_ns):
                    await tab.send_moment(glance.moment, view.robot_age_s + elapsed_s)
                if tab.wants_cloud:
                    await tab.send_picture(CLOUD, view.cloud, elapsed_s)
                before_ns = due_ns
                await asyncio.sleep((LOOK_PERIOD_NS - self._clock.now_ns() % LOOK_PERIOD_NS) / 1e9)

    def _news(self, tab: _Tab, now_ns: int) -> str:
        glance, standing = self._glances.at(now_ns), self._desk.standing(tab.number, now_ns)
        shown = glance.shown
        stamp_ms, heard_ns = tab.heard
        news = _News(
            self._version,
            standing.armed,
            standing.let_go,
            standing.accepted,
            standing.refused,
            (stamp_ms, (now_ns - heard_ns) / 1e6),
            tab.values.news({**glance.values, **own(shown, standing)}),
            tab.drawing.news(shown.view.drawing.parts()),
            tab.history.news({"listed": shown.view.history}),
        )
        return msgspec.json.encode(news).decode()


async def _turn_away(socket: WebSocket) -> None:
    """Tell a tab that its person is not logged in any more; one that takes nothing is not waited for."""
    with contextlib.suppress(WebSocketDisconnect, RuntimeError, TimeoutError):
        async with asyncio.timeout(GOODBYE_S):
            await socket.close(NOT_LOGGED_IN)


def _is_another(period_ns: int, now_ns: int, before_ns: int) -> bool:
    """Whether another period has begun since."""
    return now_ns // period_ns != before_ns // period_ns
