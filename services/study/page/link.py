"""The connection of one browser tab: what it shows out whenever that changes, what a person does in.

Nothing of a tab is kept here: one that comes again, or another one, is shown the same.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import Callable

import msgspec
from starlette.websockets import WebSocket, WebSocketDisconnect

from services.process.exceptions import ServiceError
from services.study.exceptions import ParticipantUnknown
from services.study.page import acts
from services.study.page.console import console_view
from services.study.page.desk import Desk
from services.study.page.participant import participant_view

PERIOD_S = 0.2
"""Between two looks at whether something has changed that no page did."""

UNKNOWN = 4404
"""Goodbye to the page of a participant whom there is not."""

_ENCODER = msgspec.json.Encoder()

log = logging.getLogger(__name__)


class Refused(msgspec.Struct, frozen=True):
    """What became of an act.

    Attributes:
        id: that the tab gave it.
        refused: why it does not count, in one line; empty where it does.
        faults: of a form: each question, and what is wrong with it.
    """

    id: int
    refused: str = ""
    faults: tuple[tuple[str, str], ...] = ()


class _ParticipantSays(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    id: int
    act: acts.ParticipantAct


class _ConsoleSays(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """An act, or whose parts are looked at.

    Attributes:
        id: of the act.
        act: None for a look.
        look: number of the participant; None for nobody.
    """

    id: int = 0
    act: acts.ConsoleAct | None = None
    look: int | None = None


_PARTICIPANT = msgspec.json.Decoder(_ParticipantSays)
_CONSOLE = msgspec.json.Decoder(_ConsoleSays)


class Link:
    """Of all tabs.

    Args:
        desk: of the study.
        version: of the pages' files.
    """

    def __init__(self, desk: Desk, version: str) -> None:
        self._desk = desk
        self._version = version
        self._tabs: set[asyncio.Event] = set()

    async def participant(self, socket: WebSocket) -> None:
        """Serve the page of a participant."""
        number = socket.path_params["number"]

        def view() -> bytes:
            with self._desk.lock:
                self._desk.settle(number)
                return _ENCODER.encode(participant_view(self._desk, number, self._version))

        def hear(text: str) -> Refused:
            said = _PARTICIPANT.decode(text)
            return self._done(said.id, lambda: self._desk.participant_does(number, said.act), self._faults(said.act))

        await self._serve(socket, view, hear)

    async def console(self, socket: WebSocket) -> None:
        """Serve a console."""
        looked_at: list[int | None] = [None]

        def view() -> bytes:
            with self._desk.lock:
                return _ENCODER.encode(console_view(self._desk, looked_at[0], self._version))

        def hear(text: str) -> Refused | None:
            said = _CONSOLE.decode(text)
            act = said.act
            if act is None:
                looked_at[0] = said.look
                return None
            return self._done(said.id, lambda: self._desk.console_does(act))

        await self._serve(socket, view, hear)

    async def _serve(self, socket: WebSocket, view: Callable[[], bytes], hear: Callable[[str], Refused | None]) -> None:
        await socket.accept()
        changed = asyncio.Event()
        self._tabs.add(changed)
        hearing = asyncio.create_task(self._hear(socket, hear))
        try:
            await self._show(socket, view, changed, hearing)
        except ParticipantUnknown:
            await socket.close(UNKNOWN)
        except (WebSocketDisconnect, RuntimeError):
            pass  # the tab has gone while it was spoken to
        finally:
            self._tabs.discard(changed)
            hearing.cancel()
            with contextlib.suppress(asyncio.CancelledError, WebSocketDisconnect):
                await hearing

    async def _show(
        self, socket: WebSocket, view: Callable[[], bytes], changed: asyncio.Event, hearing: asyncio.Task[None]
    ) -> None:
        shown = b""
        while not hearing.done():
            changed.clear()
            now = await asyncio.to_thread(view)
            if now != shown:
                await socket.send_text(now.decode())
                shown = now
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(changed.wait(), PERIOD_S)

    async def _hear(self, socket: WebSocket, hear: Callable[[str], Refused | None]) -> None:
        while True:
            text = await socket.receive_text()
            try:
                answer = await asyncio.to_thread(hear, text)
            except (msgspec.DecodeError, RecursionError) as error:
                log.warning("a page says what this version does not understand: %s", error)
                answer = Refused(0, "this page is of another version, or was changed: load it anew")
            if answer is not None:
                await socket.send_text(_ENCODER.encode(answer).decode())
            for tab in self._tabs:
                tab.set()

    def _done(self, number: int, act: Callable[[], None], faults: tuple[tuple[str, str], ...] = ()) -> Refused:
        try:
            act()
        except ServiceError as error:
            return Refused(number, str(error), faults)
        return Refused(number)

    def _faults(self, act: acts.ParticipantAct) -> tuple[tuple[str, str], ...]:
        """What is wrong with the answers of a form; nothing with any other act."""
        if not isinstance(act, acts.Fill):
            return ()
        instrument = self._desk.instruments.get(act.part.partition("/")[0])
        return tuple(instrument.faults(act.answers)) if instrument is not None else ()
