"""A foreign client of Zenoh that watches a robot: it knows the keys and MessagePack, and no code of the services."""

import time
from collections.abc import Callable
from dataclasses import dataclass

import msgpack

from tests.system.harness import START_S, eventually
from tests.system.stranger import Stranger

STANDING = {"idle", "stopped"}
"""The phases of a robot that nobody asked to move."""

POLL_S = 0.02


@dataclass(frozen=True)
class Seen:
    """A robot's state as it passed.

    Attributes:
        at: when, monotonic [s].
        phase: of the robot.
        position: of the gripper, as measured [m].
        q: of the joints, as measured [rad].
        waiting: it waits to be asked to go on.
    """

    at: float
    phase: str
    position: tuple[float, float, float]
    q: tuple[float, ...]
    waiting: bool


class Onlooker(Stranger):
    """Watches one robot; a context manager.

    Args:
        endpoint: of the router.
        robot: the robot's name.
    """

    def __init__(self, endpoint, robot="robot1"):
        super().__init__(endpoint)
        self._seen: list[Seen] = []
        self.safety: dict = {}
        self._subscribe(f"retouch/@v1/{robot}/state/robot/*", self._see)
        self._subscribe(f"retouch/@v1/{robot}/safety/state/*", self._see_safety)

    def _see(self, fields):
        position = tuple(fields["measured"]["position"])
        seen = Seen(time.monotonic(), fields["phase"], position, tuple(fields["q"]), fields.get("waiting", False))
        self._seen.append(seen)

    def _see_safety(self, fields):
        self.safety = fields

    def _subscribe(self, key: str, see: Callable[[dict], None]):
        self.watch(key, lambda passing: see(msgpack.unpackb(passing.payload)))

    def since(self, at):
        """What was seen after a moment, monotonic [s]."""
        return [seen for seen in list(self._seen) if seen.at > at]

    def until(self, seen, within_s, what):
        """The first state from now on of which `seen` is true."""
        began = time.monotonic()
        return eventually(lambda: next(filter(seen, self.since(began)), None), within_s, what)

    def phases_of(self, duration_s):
        """The phases of the next so many seconds of a robot that is heard; waits until it is."""
        self.until(lambda seen: True, START_S, "the robot is heard")
        began = time.monotonic()
        while time.monotonic() - began < duration_s:
            time.sleep(POLL_S)
        heard = self.since(began)
        assert heard, "the robot fell silent"
        return {seen.phase for seen in heard}
