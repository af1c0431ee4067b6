"""One run of the viewer: streamed live to whoever looks on, and at the same time written to files."""

from __future__ import annotations

import secrets
from collections.abc import Sequence
from pathlib import Path

import rerun as rr

from services.process.config import ViewerSection
from services.viewer import entities
from services.viewer.blueprint import blueprint
from services.viewer.live import open_live
from services.viewer.parts import Painter, Parts
from sim.tasks.scene import Eye

_CLOSE_S = 1.0


class Run:
    """Everything that is shown: each thing is drawn for those who look on, and in the file.

    Args:
        section: where it is served, and the folder for the files.
        robot: the robot's name, with which the files' begin.
        start_ns: where the time line begins [ns].
        eye: from where the scene is seen at first.

    Raises:
        PortInUse: nothing can listen at the stream's port.
        FolderUnusable: the folder cannot be written to.
    """

    def __init__(self, section: ViewerSection, robot: str, start_ns: int, eye: Eye) -> None:
        self.identity = secrets.token_hex(8)
        self._start_ns = start_ns
        self._live = open_live(section, self.identity)
        try:
            self.parts = Parts(Path(section.folder), robot, self.identity)
        except BaseException:
            self._live.disconnect()
            raise
        self._streams: tuple[rr.RecordingStream, ...] = ()
        self._standing: dict[str, object] = {}
        layout, name = blueprint(eye), self.parts.path.stem
        self.always("layout", lambda stream: stream.send_blueprint(layout))
        self.always("name", lambda stream: stream.send_recording_name(name))

    def at(self, now_ns: int) -> float:
        """Draw at this moment from now on; the time on the time line [s]."""
        time_s = (now_ns - self._start_ns) / 1e9
        file = self.parts.stream
        self._streams = (self._live,) if file is None else (self._live, file)
        for stream in self._streams:
            stream.set_time(entities.TIMELINE, duration=time_s)
        return time_s

    def log(self, path: str, entity: rr.AsComponents) -> None:
        """Draw something now."""
        for stream in self._streams:
            stream.log(path, entity)

    def send_columns(self, path: str, times: rr.TimeColumn, columns: Sequence[rr.ComponentColumn]) -> None:
        """Draw several rows at once."""
        for stream in self._streams:
            stream.send_columns(path, [times], columns)

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
        self.parts.close(_CLOSE_S)
        self._live.disconnect()
