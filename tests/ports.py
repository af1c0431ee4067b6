"""Ports of this machine for tests that run beside each other, in one process or several."""

import random
import socket

FIRST, LAST = 20_000, 32_000
"""Below the ports that the system gives to whoever connects."""

_taken = []


def free_port():
    """A TCP port where nobody listens, and which no other test is given while this process lives."""
    while True:
        port = random.SystemRandom().randint(FIRST, LAST)
        # A name that one process of the machine can have, and that goes with it.
        claim = socket.socket(socket.AF_UNIX)
        try:
            claim.bind(f"\0retouch-tests-port-{port}")
            socket.create_server(("127.0.0.1", port)).close()
        except OSError:
            claim.close()
            continue
        _taken.append(claim)
        return port
