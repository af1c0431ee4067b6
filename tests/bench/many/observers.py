"""Many who look at one robot, each over a session of its own.

Usage: observers.py ENDPOINT ROBOT COUNT. It says "ready"; a line "on" on its input lets all of them subscribe to
everything of the robot, "off" ends that. It answers with how many of them have heard the robot meanwhile.
"""

import sys
from pathlib import Path

import zenoh

sys.path.insert(0, str(Path(__file__).parents[3]))

from protocol.topic import VERSION
from services.bus.zenoh import open_session

START_S = 60.0


def main(endpoint, robot, count):
    """See the module."""
    sessions = [open_session(endpoint, START_S) for _ in range(int(count))]
    key, looking = f"retouch/{VERSION}/{robot}/**", []
    print("ready", flush=True)
    for line in sys.stdin:
        if line.strip() == "on":
            # What comes is kept in Zenoh: these observers are to load the router, not this machine.
            looking = [one.current.declare_subscriber(key, zenoh.handlers.RingChannel(1)) for one in sessions]
            print(0, flush=True)
            continue
        print(sum(map(heard, looking)), flush=True)
        looking = []


def heard(subscriber):
    """Whether something came; nothing does any more where the link was lost meanwhile. Ends the subscription."""
    try:
        came = subscriber.try_recv() is not None
        subscriber.undeclare()
    except zenoh.ZError:
        return False
    return came


if __name__ == "__main__":
    main(*sys.argv[1:])
