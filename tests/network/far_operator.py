"""An operator on the far machine: holds the authority, starts one motion, renews, and presses the stop when told to.

Usage: far_operator.py ENDPOINT. It says "executing" once the motion has begun; a line "stop" on its input makes it
press until that is confirmed, and then it says "confirmed". It never asks to go on: whatever moves after that moves by
itself.
"""

import sys
import threading
import time
from pathlib import Path

import msgspec
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))

from protocol import queries, topics
from protocol.messages import AuthorityRenewal, Mode, Prediction
from services.bus.arrays import motion_to_wire, to_wire
from services.bus.identity import new_number
from services.bus.zenoh import connect
from services.commands.pressing import Press
from services.process.clock import SystemClock

ROBOT = "robot1"
HOLDER = "station-far"
MOTION_S = 60.0
STRAIGHT_M = 0.4
RENEWAL_S = 1.0 / topics.AUTHORITY_RENEWAL.rate_hz
PRESS_S = 1.0 / topics.EMERGENCY_STOP.rate_hz


def straight():
    """A slow motion of the particle."""
    positions = np.column_stack([np.linspace(0.0, STRAIGHT_M, 75), np.zeros(75), np.zeros(75)])
    motion = motion_to_wire(positions, np.tile((1.0, 0.0, 0.0, 0.0), (75, 1)), 10.0)
    deviations = to_wire(np.zeros((75, 3)))
    return Prediction(
        id=new_number(), motion=motion, deviations=deviations, model_version=1, object_position=(STRAIGHT_M, 0.0, 0.0)
    )


def answered(bus, query, request):
    """The positive answer; asked until there is one, with another number after a refusal."""
    while True:
        pending = bus.ask(query, request)
        while (outcome := pending.poll()) is None:
            time.sleep(0.01)
        if isinstance(outcome, query.reply):
            return outcome
        if isinstance(outcome, queries.Refused):
            request = msgspec.structs.replace(request, request=new_number())
        time.sleep(0.2)


def renew(bus, epoch):
    """Be present for ever."""
    while True:
        bus.publish(topics.AUTHORITY_RENEWAL, AuthorityRenewal(operator="far", holder=HOLDER, epoch=epoch))
        time.sleep(RENEWAL_S)


def main(endpoint):
    """See the module."""
    clock = SystemClock()
    bus = connect(endpoint, ROBOT, HOLDER, clock)
    model = connect(endpoint, ROBOT, "model-far", clock)
    epoch = answered(bus, queries.ACQUIRE, queries.AcquireAuthority(HOLDER, "far")).epoch
    threading.Thread(target=renew, args=(bus, epoch), daemon=True).start()
    prediction = straight()

    def announce():
        while True:
            model.publish(topics.PREDICTION, prediction)
            time.sleep(1.0)

    threading.Thread(target=announce, daemon=True).start()
    execute = queries.Execute(epoch, Mode.AUTONOMOUS, prediction.id, MOTION_S, request=new_number())
    answered(bus, queries.EXECUTE, execute)
    print("executing", flush=True)
    for line in sys.stdin:
        assert line == "stop\n", line
        press = Press(bus, "far")
        while press.step(clock.now_ns()):
            time.sleep(PRESS_S)
        print("confirmed", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
