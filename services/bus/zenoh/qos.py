"""The qualities of service in Zenoh's words."""

from __future__ import annotations

from dataclasses import dataclass

import zenoh

from protocol.topic import QoS


@dataclass(frozen=True)
class Manner:
    """Zenoh's words for a quality of service."""

    priority: zenoh.Priority
    congestion_control: zenoh.CongestionControl
    express: bool


# Nothing blocks: a full link must not stop a control loop. What must not be lost is repeated by its publisher; a
# question that was lost fails in time and is asked again. An answer travels as its question did.
MANNERS = {
    QoS.SAFETY: Manner(zenoh.Priority.REAL_TIME, zenoh.CongestionControl.DROP, True),
    QoS.REALTIME: Manner(zenoh.Priority.INTERACTIVE_HIGH, zenoh.CongestionControl.DROP, True),
    QoS.STATE: Manner(zenoh.Priority.INTERACTIVE_LOW, zenoh.CongestionControl.DROP, True),
    QoS.PICTURE: Manner(zenoh.Priority.DATA_LOW, zenoh.CongestionControl.DROP, False),
    QoS.EVENT: Manner(zenoh.Priority.DATA_HIGH, zenoh.CongestionControl.DROP, False),
}
