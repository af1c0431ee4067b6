"""One run of the viewer: streamed live to whoever looks on, and at the same time written to files."""

from __future__ import annotations

import secrets
from collections.abc import Sequence
from pathlib import Path
from typing import TypeVar

import rerun as rr

from services.process.config import ViewerSection
from services.viewer import entities
from services.viewer.blueprint import blueprint
from services.viewer.kinds import Kind
from services.viewer.live import open_live
from services.viewer.parts import Painter, Parts
from services.viewer.rows import Rows
from sim.tasks.scene import Eye

V = TypeVar("V")

LIVE_S = 0.18
"""Rows are gathered for so long before those who look on see them, which is six of them: an eye cannot tell."""

RECORDED_S = 0.8
"""Rows are gathered for so long before they are written: a kill costs no more than a second of them."""

_CLOSE_S = 1.0


class Run:
    """Everything that is shown: each thing is drawn for those who look on, and in the file.

    Args:
        section: where it is served, and the folder for the files.
        robot: the robot's name, with which the files' begin.
        start_ns: where the time line begins [ns].
        eye: from where the scene is seen at first.
        cameras: their names.

    Raises:
        PortInUse: nothing can listen at the stream's port.
        FolderUnusable: the folder cannot be written to.
    """

    def __init__(self, section: ViewerSection, robot: str, start_ns: int, eye: Eye, cameras: Sequence[str]) -> None:
        self.identity = secrets.token_hex(8)
        self._start_ns = start_ns
        self._live = open_live(section, self.identity)
        try:
            self.parts = Parts(Path(section.folder), robot, self.identity)
        except BaseException:
            self._live.disconnect()
            raise
        self._streams: tuple[rr.RecordingStream, ...] = ()
        self._live_rows, self._recorded_rows = Rows(LIVE_S), Rows(RECORDED_S)
        self._now_ns, self._time_s = start_ns, 0.0
        self._standing: dict[str, object] = {}
        layout, name = blueprint(eye, cameras), self.parts.path.stem
        self.always("layout", lambda stream: stream.send_blueprint(layout))
        self.always("name", lambda stream: stream.send_recording_name(name))

    def at(self, now_ns: int) -> None:
        """Draw at this moment from now on."""
        self._now_ns, self._time_s = now_ns, (now_ns - self._start_ns) / 1e9
        file = self.parts.stream
        self._streams = (self._live,) if file is None else (self._live, file)
        for stream in self._streams:
            stream.set_time(entities.TIMELINE, duration=self._time_s)

    def log(self, path: str, entity: rr.AsComponents) -> None:
        """Draw something now."""
        for stream in self._streams:
            stream.log(path, entity)

    def row(self, path: str, kind: Kind[V], value: V) -> None:
        """Draw something of what comes often; it is seen and written with the next rows."""
        for rows in (self._live_rows, self._recorded_rows):
            rows.add(path, kind, value, self._time_s, self._now_ns)

    def send(self) -> None:
        """Send the rows that were gathered for long enough."""
        if self._live_rows.due(self._now_ns):
            self._live_rows.send(self._live)
        if self._recorded_rows.due(self._now_ns):
            self._recorded_rows.send(self.parts.stream)
            self.parts.ask()

    def stand(self, path: str, entity: rr.AsComponents, value: object) -> None:
        """Draw what stands until it is drawn anew: on the time line in the file, but at once for whoever comes late.

        Args:
            path: where it lies.
            entity: to draw.
            value: that it shows; those who look on are sent it where that has changed.
        """
        if self._standing.get(path) != value:
            self._standing[path] = value
            self._live.log(path, entity, static=True)
        for stream in self._streams[1:]:
            stream.log(path, entity)

    def always(self, name: str, painter: Painter) -> None:
        """Draw what has no time; it replaces what had this name."""
        painter(self._live)
        self.parts.paint(name, painter)

    def log_always(self, path: str, entity: rr.AsComponents) -> None:
        """Draw something that has no time."""
        self.always(path, lambda stream: stream.log(path, entity, static=True))

    def close(self) -> None:
        """Finish the file, then stop serving."""
        self._live_rows.send(self._live)
        self._recorded_rows.send(self.parts.stream)
        self.parts.close(_CLOSE_S)
        self._live.disconnect()
