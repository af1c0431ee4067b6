"""A way from one process to another, of real processes: its router where it needs one, sender, camera, receiver."""

import contextlib
import json
import os
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from protocol import topics
from protocol.codec import encode
from services.bus.identity import new_publisher
from services.bus.outbox import Outbox
from tests.bench.wire.command import MASTER, MOVED, ROBOT
from tests.bench.wire.peers import python_of
from tests.bench.wire.program import now_ns
from tests.ports import free_port

PROGRAM = Path(__file__).with_name("program.py")
REACHES_S = 30.0
SETTLE_S = 0.3
"""What is on its way after the last message comes within it."""

WARM_S = 0.5
"""From the beginning of a burst, and left out."""

PROBE_HZ = 50.0


@dataclass(frozen=True)
class Carrier:
    """A way, as it is called and what it has.

    Attributes:
        name: of its module in `carriers`.
        about: what to call it.
        routed: a router or broker is between the ends.
        secure: it can show certificates.
    """

    name: str
    about: str
    routed: bool = False
    secure: bool = False


CARRIERS = (
    Carrier("raw_zenoh", "raw Zenoh", routed=True, secure=True),
    Carrier("ours", "the bus", routed=True, secure=True),
    Carrier("bare_zenoh", "raw Zenoh, bare bytes", routed=True, secure=True),
    Carrier("udp", "UDP sockets"),
    Carrier("tcp", "TCP sockets", secure=True),
    Carrier("pyzmq", "pyzmq"),
    Carrier("cyclonedds", "Cyclone DDS"),
    Carrier("mqtt", "MQTT (paho, amqtt)", routed=True, secure=True),
)
"""The first one is what the others are compared with."""


@dataclass(frozen=True)
class Burst:
    """What came of the messages of a burst that count.

    Attributes:
        latencies_us: of each one that came, from before it is sent until it is there [us].
        sent: how many were.
        pictures: came meanwhile.
    """

    latencies_us: np.ndarray
    sent: int
    pictures: int

    @property
    def lost(self):
        """The share that did not come."""
        return 1.0 - len(self.latencies_us) / self.sent


def payload():
    """An encoded state of a master, as it is sent."""
    outbox = Outbox(new_publisher(), ROBOT, MASTER)
    return encode(topics.MASTER_STATE, outbox.stamp(topics.MASTER_STATE, MOVED, now_ns()))


class Way:
    """The processes of a way; a context manager.

    Args:
        carrier: which way.
        certificates: folder of the authority whose certificates are shown; None for none.

    Raises:
        Absent: it cannot be installed.
        Broken: its processes do not reach each other.
    """

    def __init__(self, carrier, certificates=None):
        self.carrier = carrier
        self.secure = certificates is not None
        self._settings = json.dumps(
            {
                "ports": [free_port(), free_port()],
                "certificates": None if certificates is None else str(certificates),
                "payload": payload().hex(),
            }
        )
        self._python = python_of(carrier.name)
        self._stack = contextlib.ExitStack()

    @property
    def about(self):
        """What to call it."""
        return f"{self.carrier.about}{', TLS' if self.secure else ''}"

    def __enter__(self):
        with contextlib.ExitStack() as stack:
            if self.carrier.routed:
                stack.enter_context(self._end("router"))
            self._receiver = stack.enter_context(self._end("receiver"))
            self._sender = stack.enter_context(self._end("sender"))
            self._camera = stack.enter_context(self._end("camera"))
            self._reach()
            self._stack = stack.pop_all()
        return self

    def __exit__(self, *_):
        self._stack.close()

    @contextlib.contextmanager
    def _end(self, end):
        command = [self._python, "-I", PROGRAM, end, self.carrier.name, self._settings]
        environment = {**os.environ, "OMP_NUM_THREADS": "1"}
        process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment
        )
        try:
            if process.stdout.readline() != "ready\n":
                process.kill()
                raise Broken(
                    f"{self.about}: its {end} ends: {(process.stderr.read().strip().splitlines() or ['?'])[-1]}"
                )
            yield process
        finally:
            process.kill()
            process.wait()
            for stream in (process.stdin, process.stdout, process.stderr):
                with contextlib.suppress(BrokenPipeError):
                    stream.close()

    def _ask(self, process, line):
        try:
            process.stdin.write(f"{line}\n")
            process.stdin.flush()
            return json.loads(process.stdout.readline())
        except (OSError, ValueError):
            raise Broken(f"{self.about}: a process of it has ended") from None

    def _reach(self):
        """Wait until messages of both kinds come."""
        deadline, heard = time.monotonic() + REACHES_S, {"samples": False, "pictures": False}
        self._ask(self._camera, "on")
        while not all(heard.values()):
            if time.monotonic() > deadline:
                raise Broken(f"{self.about}: nothing comes of {', '.join(what for what in heard if not heard[what])}")
            self._ask(self._sender, f"{PROBE_HZ} 0.2 0")
            took = self._ask(self._receiver, "take")
            heard = {what: bool(heard[what] or took[what]) for what in heard}
        self._ask(self._camera, "off")

    def burst(self, rate_hz, seconds, pictures):
        """Send for so long, with pictures beside or not; what came."""
        self._ask(self._camera, "on" if pictures else "off")
        self._ask(self._receiver, "take")
        first_ns, sent = self._ask(self._sender, f"{rate_hz} {seconds} {WARM_S}")
        self._ask(self._camera, "off")
        time.sleep(SETTLE_S)
        took = self._ask(self._receiver, "take")
        counted = [(came - sent_ns) / 1e3 for sent_ns, came in took["samples"] if sent_ns >= first_ns]
        return Burst(np.array(counted), sent, took["pictures"])


class Broken(Exception):
    """A way whose processes do not reach each other; says so in one line."""
