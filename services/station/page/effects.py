"""What entries of the history change, as far as a tab has asked for it: from the station's thread to the browser."""

from __future__ import annotations

import threading
from collections import OrderedDict

import msgspec
from starlette.requests import Request
from starlette.responses import Response

from protocol.messages import Array, Motion
from protocol.queries import Effect, Refused
from services.bus.arrays import Floats, drawable
from services.station.live_view.drawing import Point
from services.station.live_view.stage import told
from services.station.words.heard import heard

KEPT = 64
"""Effects, and entries that are waited for."""

_SHARE = 2
"""Digits of what is known."""

_WORKING, _GONE, _JSON = 202, 204, "application/json"


class Moved(msgspec.Struct, frozen=True):
    """How far predictions are moved over the places of a target; see `protocol.history.Field`.

    Attributes:
        axes: which two of a place's numbers vary: along the rows, along the columns.
        lower: the least of both [m].
        upper: the greatest [m].
        moved: by rows [m].
        known: by rows, with the entry.
    """

    axes: tuple[int, int]
    lower: tuple[float, float]
    upper: tuple[float, float]
    moved: tuple[Point, ...]
    known: tuple[Point, ...]


class Comparison(msgspec.Struct, frozen=True):
    """What an entry changes, as the page draws it: points in the base frame [m].

    Attributes:
        place: where its object stood.
        with_it: the motion there with it; empty where there is none.
        without_it: the same without it.
        field: the same over all places; None where there is nothing to compare.
    """

    place: Point
    with_it: tuple[Point, ...]
    without_it: tuple[Point, ...]
    field: Moved | None


class Incomparable(msgspec.Struct, frozen=True):
    """What is told instead where an entry cannot be compared.

    Attributes:
        refused: why, as the reader's language has it.
    """

    refused: str


class Effects:
    """The newest effects, and what is waited for. Safe to use from several threads."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._version = 0
        self._wanted: OrderedDict[int, None] = OrderedDict()
        self._known: OrderedDict[int, bytes] = OrderedDict()

    def renew(self, version: int) -> None:
        """The model, or the skill, has become another one: what is known of the old one is nothing to show."""
        with self._lock:
            if version != self._version:
                self._version = version
                self._wanted.clear()
                self._known.clear()

    def wanted(self) -> int | None:
        """The entry that is looked at, or was asked for first, and is not there yet; None where none is."""
        with self._lock:
            return next(iter(self._wanted), None)

    def put(self, version: int, entry: int, effect: Effect | Refused) -> None:
        """Keep what an entry changes, or why that cannot be said."""
        shown = msgspec.json.encode(
            Incomparable(heard(effect.reason)) if isinstance(effect, Refused) else _shown(effect)
        )
        with self._lock:
            self._wanted.pop(entry, None)
            if version != self._version:
                return
            self._known[entry] = shown
            if len(self._known) > KEPT:
                self._known.popitem(last=False)

    async def serve(self, request: Request) -> Response:
        """Answer a browser, at /history/VERSION/ENTRY: what it asks for is there soon where it is not yet.

        With ?first=1 somebody looks at it, and it comes before what nobody looks at.
        """
        version, entry = request.path_params["version"], request.path_params["entry"]
        with self._lock:
            if version != self._version:
                return Response(status_code=_GONE)
            found = self._known.get(entry)
            if found is None:
                is_first = "first" in request.query_params
                if is_first or len(self._wanted) < KEPT:
                    self._wanted[entry] = None
                    if is_first:
                        self._wanted.move_to_end(entry, last=False)
                    if len(self._wanted) > KEPT:
                        self._wanted.popitem()
                return Response(status_code=_WORKING)
        return Response(found, media_type=_JSON, headers={"Cache-Control": "no-store"})


def _shown(effect: Effect) -> Comparison:
    field = effect.field
    return Comparison(
        effect.object_position,
        _line(effect.with_it),
        _line(effect.without_it),
        None
        if field is None
        else Moved(field.axes, field.lower, field.upper, _rows(field.moved, 4), _rows(field.known, _SHARE)),
    )


def _line(motion: Motion | None) -> tuple[Point, ...]:
    points = None if motion is None else drawable(motion.positions)
    return () if points is None else told(points)


def _rows(array: Array, digits: int) -> tuple[Point, ...]:
    values: Floats | None = drawable(array)
    return () if values is None or values.ndim != 2 else tuple(map(tuple, values.round(digits).tolist()))
