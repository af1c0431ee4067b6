"""What is sent: the state of a master whose hand leads."""

from protocol.messages import MasterState

ROBOT, MASTER = "kitchen", "master-anna"
MOVED = MasterState(
    displacement=(0.0123, -0.0045, 0.0311),
    velocity=(0.02, 0.011, -0.034),
    force=(0.61, -0.2, 1.33),
    engaged=True,
    operator="anna",
    holder="station-anna",
    epoch=7,
    device="keyboard",
    echoed_ns=123_456_789_012,
    echo_held_ns=4_000_000,
)
