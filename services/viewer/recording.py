"""One run of the viewer: streamed live to whoever looks on, and at the same time written to a file."""

from __future__ import annotations

import secrets
import socket
from datetime import UTC, datetime
from pathlib import Path

import rerun as rr

from services.process.config import ViewerSection
from services.process.exceptions import PortInUse
from services.viewer import entities
from services.viewer.blueprint import blueprint
from services.viewer.exceptions import ViewerError
from sim.tasks.scene import Eye

# Enough for a page that is opened late to be live within two seconds; a large buffer would be played back first.
_LATE_JOINERS_MEMORY = "32MiB"

# Three frames a chunk: with one, most of the file and of the time would be the chunks' headers.
_FLUSH_S = 0.1


class Recording:
    """The stream of everything that is shown.

    Args:
        section: where it is served, and the folder for the files.
        robot: the robot's name, with which the file's begins.
        start_ns: where the time line begins [ns].
        eye: from where the scene is seen at first.

    Raises:
        PortInUse: nothing can listen at the stream's port.
        ViewerError: the folder cannot be written to.
    """

    def __init__(self, section: ViewerSection, robot: str, start_ns: int, eye: Eye) -> None:
        self.identity = secrets.token_hex(8)
        self.path = _new_file(Path(section.folder), robot)
        self._start_ns = start_ns
        _check_free(section.host, section.stream_port, "[viewer] stream_port")
        self.stream = rr.RecordingStream(
            "retouch",
            recording_id=self.identity,
            batcher_config=rr.ChunkBatcherConfig(flush_tick=_FLUSH_S),
        )
        self.stream.set_sinks(
            rr.GrpcServerSink(
                bind_ip=section.host,
                port=section.stream_port,
                server_memory_limit=_LATE_JOINERS_MEMORY,
                newest_first=True,
                cors_allow_origin=web_origins(section),
            ),
            rr.FileSink(self.path),
            default_blueprint=blueprint(eye),
        )
        self.stream.set_log_time_enabled(False)
        self.stream.set_log_tick_enabled(False)
        self.stream.send_recording_name(self.path.stem)

    def at(self, now_ns: int) -> float:
        """Log at this moment from now on; the time on the time line [s]."""
        time_s = (now_ns - self._start_ns) / 1e9
        self.stream.set_time(entities.TIMELINE, duration=time_s)
        return time_s

    def close(self) -> None:
        """Write everything to the file and stop serving."""
        self.stream.flush()
        self.stream.disconnect()


def public_host(host: str) -> str:
    """The name by which a browser reaches this host.

    On one machine it is not the one of the operator's page, which is on 127.0.0.1: from another host name the
    browser gives the view a process of its own, and its drawing does not delay the operator's keys.
    """
    if host in ("127.0.0.1", "localhost", "::1"):
        return "localhost"
    return socket.gethostname() if host in ("0.0.0.0", "::") else host


def web_origins(section: ViewerSection) -> list[str]:
    """The pages that may read the stream."""
    names = dict.fromkeys((public_host(section.host), section.host))
    return [f"http://{name}:{section.web_port}" for name in names]


def _new_file(folder: Path, robot: str) -> Path:
    path = folder.absolute() / f"{robot}-{datetime.now(UTC):%Y%m%dT%H%M%SZ}.rrd"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        path.touch()
    except OSError as error:
        reason = f"cannot record to {path}: {error.strerror}; set another folder in the configuration: [viewer] folder"
        raise ViewerError(reason) from None
    return path


def _check_free(host: str, port: int, setting: str) -> None:
    # The SDK's server says so in its own log only.
    with socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET) as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((host, port))
        except OSError as error:
            raise PortInUse("the live stream", host, port, setting, error.strerror or "") from None
