"""What comes often, gathered and sent as one chunk of each entity: a chunk for every row would be mostly header."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np
import rerun as rr

from services.viewer import entities
from services.viewer.kinds import Kind

V = TypeVar("V")


class Rows:
    """Rows on their way to a stream.

    Args:
        every_s: how long they are gathered [s].
    """

    def __init__(self, every_s: float) -> None:
        self._every_ns = every_s * 1e9
        self._began_ns: int | None = None
        self._gathered: dict[tuple[str, Kind[Any]], tuple[list[float], list[Any]]] = {}

    def add(self, path: str, kind: Kind[V], value: V, time_s: float, now_ns: int) -> None:
        """Gather a value.

        Args:
            path: of the entity.
            kind: of the value.
            value: at this time.
            time_s: on the time line [s].
            now_ns: the time [ns].
        """
        if self._began_ns is None:
            self._began_ns = now_ns
        times, values = self._gathered.setdefault((path, kind), ([], []))
        times.append(time_s)
        values.append(value)

    def due(self, now_ns: int) -> bool:
        """Whether they were gathered for long enough."""
        return self._began_ns is not None and now_ns - self._began_ns >= self._every_ns

    def send(self, stream: rr.RecordingStream | None) -> None:
        """Send what was gathered; without a stream it is let go."""
        gathered, self._gathered, self._began_ns = self._gathered, {}, None
        if stream is None:
            return
        for (path, kind), (times, values) in gathered.items():
            index = rr.TimeColumn(entities.TIMELINE, duration=np.repeat(times, kind.rows))
            stream.send_columns(path, [index], kind.columns(values))
