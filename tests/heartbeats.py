"""What a process says of itself, as tests need it."""

import msgspec

from protocol.messages import Heartbeat


def heartbeat(process="robot", **changed):
    """One of a process that does as it should, but for what is changed."""
    beat = Heartbeat(
        process=process,
        pid=1,
        host="site",
        rate_hz=100.0,
        ticks=1,
        late_ticks=0,
        period_p50=0.01,
        period_p99=0.01,
        step_p99=0.001,
        cpu_s=1.0,
        memory=1,
    )
    return msgspec.structs.replace(beat, **changed)
