"""Carries packets between two TUN devices, late, thinned, slowed or not at all; started by `tests.network.link`.

Real packets of a real kernel pass here, so that TCP retransmits and backs off as it does on a bad network.

Usage: forwarder.py NEAR FAR. Each line of JSON on its input changes the link, and is answered by a line; the end of
the input ends it.
"""

import contextlib
import fcntl
import heapq
import json
import os
import random
import selectors
import struct
import sys
import time
from dataclasses import dataclass, field, replace

_TUNSETIFF = 0x400454CA
_IFF_TUN = 0x0001
_IFF_NO_PI = 0x1000
_PACKET = 65536
_FULL_PACKET = 1500


@dataclass(frozen=True)
class Shape:
    """What the link does to each direction's packets.

    Attributes:
        cut: nothing passes, and nobody is told.
        delay_s: of each packet [s].
        jitter_s: the delay varies by so much, either way; the order stays [s].
        loss: share of packets that are lost.
        reordered: share of packets that take half the delay, and so overtake others.
        duplicated: share of packets that come twice.
        rate: most that passes [bit/s]; 0 for no bound.
        queue: full packets that wait at most where the rate is bounded; what finds no room is lost.
    """

    cut: bool = False
    delay_s: float = 0.0
    jitter_s: float = 0.0
    loss: float = 0.0
    reordered: float = 0.0
    duplicated: float = 0.0
    rate: float = 0.0
    queue: int = 200


@dataclass
class Direction:
    """The packets from one device to the other."""

    source: int
    sink: int
    shape: Shape = Shape()
    _waiting: list = field(default_factory=list)
    _count: int = 0
    _last_s: float = 0.0
    _free_s: float = 0.0
    _random: random.Random = field(default_factory=lambda: random.Random(1))  # of its own, the same in each run

    def take(self, now):
        """Read what has come, and give each packet its time."""
        with contextlib.suppress(BlockingIOError):
            while True:
                self._admit(os.read(self.source, _PACKET), now)

    def _admit(self, packet, now):
        shape = self.shape
        if shape.cut or self._random.random() < shape.loss:
            return
        sent = now
        if shape.rate:
            if (self._free_s - now) * shape.rate > 8 * _FULL_PACKET * shape.queue:
                return
            self._free_s = sent = max(now, self._free_s) + 8 * len(packet) / shape.rate
        if self._random.random() < shape.reordered:
            self._push(sent + 0.5 * shape.delay_s, packet)
            return
        due = sent + shape.delay_s + self._random.uniform(-1.0, 1.0) * shape.jitter_s
        self._last_s = due = max(due, self._last_s)
        self._push(due, packet)
        if self._random.random() < shape.duplicated:
            self._push(due, packet)

    def _push(self, due, packet):
        self._count += 1
        heapq.heappush(self._waiting, (due, self._count, packet))

    def give(self, now):
        """Write what is due; when the next one is [s]."""
        while self._waiting and self._waiting[0][0] <= now:
            _, _, packet = heapq.heappop(self._waiting)
            if not self.shape.cut:
                with contextlib.suppress(OSError):
                    os.write(self.sink, packet)
        return self._waiting[0][0] if self._waiting else float("inf")


def tun(name):
    """A new TUN device."""
    device = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(device, _TUNSETIFF, struct.pack("16sH", name.encode(), _IFF_TUN | _IFF_NO_PI))
    return device


def main(near, far):
    """Forward until the input ends."""
    devices = (tun(near), tun(far))
    directions = (Direction(*devices), Direction(*reversed(devices)))
    print("up", flush=True)
    with selectors.DefaultSelector() as ready:
        for direction in directions:
            ready.register(direction.source, selectors.EVENT_READ, direction)
        ready.register(sys.stdin, selectors.EVENT_READ)
        while True:
            now = time.monotonic()
            due = min(direction.give(now) for direction in directions)
            for key, _ in ready.select(min(0.5, max(0.0, due - now))):
                if key.data is not None:
                    key.data.take(time.monotonic())
                    continue
                line = sys.stdin.readline()
                if not line:
                    return
                for direction in directions:
                    direction.shape = replace(direction.shape, **json.loads(line))
                print("changed", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
