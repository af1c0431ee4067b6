"""The live stream: what a page that is opened now sees at once, and one that is opened late within two seconds."""

from __future__ import annotations

import rerun as rr

from services.process.addresses import EVERYWHERE, LOOPBACK_NAMES, in_url
from services.process.config import ViewerSection
from services.process.ports import check_port

APPLICATION = "retouch"

# A large buffer would be played back first to whoever comes late.
_LATE_JOINERS_MEMORY = "32MiB"

# Three frames a chunk: with one, most of the time would go into the chunks' headers.
_FLUSH_S = 0.1


def open_live(section: ViewerSection, identity: str) -> rr.RecordingStream:
    """A stream that is served to whoever looks on.

    Args:
        section: where.
        identity: of the recording.

    Raises:
        PortInUse: nothing can listen at the stream's port.
    """
    check_port("the live stream", section.host, section.stream_port, "[viewer] stream_port")
    stream = rr.RecordingStream(
        APPLICATION, recording_id=identity, batcher_config=rr.ChunkBatcherConfig(flush_tick=_FLUSH_S)
    )
    server = rr.GrpcServerSink(
        bind_ip=section.host,
        port=section.stream_port,
        server_memory_limit=_LATE_JOINERS_MEMORY,
        newest_first=True,
        cors_allow_origin=page_origins(section),
    )
    stream.set_sinks(server)
    only_our_time(stream)
    return stream


def only_our_time(stream: rr.RecordingStream) -> None:
    """Leave Rerun's own time lines out: the robot's messages have one."""
    stream.set_log_time_enabled(False)
    stream.set_log_tick_enabled(False)


def page_origins(section: ViewerSection) -> list[str]:
    """The pages that may read the stream: the viewer's own, under any name where it listens on every address."""
    names = ["*"] if section.host in EVERYWHERE else sorted(in_url(name) for name in {section.host, *LOOPBACK_NAMES})
    return [f"http://{name}:{section.web_port}" for name in names]
