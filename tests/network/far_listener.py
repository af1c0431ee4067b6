"""Hears several robots on the far machine, and counts whether what counts under a name is what was sent under it.

Usage: far_listener.py ENDPOINT ROBOT... It says "listening"; each line on its input makes it tell, as JSON, how many
messages counted on each robot's topics, which of them were another's, and how many the receiver had refused as
misplaced. The end of its input ends it.
"""

import json
import secrets
import select
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

from services.bus.zenoh import connect
from services.process.clock import SystemClock
from tests.network.naming import TOPICS, written

LOOK_S = 0.005


class Ear:
    """One robot's topics, as they count."""

    def __init__(self, endpoint, robot):
        self._robot = robot
        bus = connect(endpoint, robot, f"witness-{secrets.token_hex(4)}", SystemClock())
        self.heard = {topic.name: bus.subscribe(topic) for topic in TOPICS}
        self.counted = dict.fromkeys(self.heard, 0)
        self.wrong = []

    def take(self):
        """Look at what has come."""
        for name, subscription in self.heard.items():
            for received in subscription.take():
                self.counted[name] += 1
                if (said := written(received.message)) != f"{self._robot} {name}":
                    self.wrong.append(f"{said} under {self._robot} {name}")

    def told(self):
        """What became of everything."""
        misplaced = sum(subscription.drops.misplaced for subscription in self.heard.values())
        return {"counted": self.counted, "wrong": self.wrong, "misplaced": misplaced}


def main(endpoint, *robots):
    """See the module."""
    ears = {robot: Ear(endpoint, robot) for robot in robots}
    print("listening", flush=True)
    while True:
        asked, _, _ = select.select([sys.stdin], [], [], LOOK_S)
        for ear in ears.values():
            ear.take()
        if asked:
            if not sys.stdin.readline():
                return
            print(json.dumps({robot: ear.told() for robot, ear in ears.items()}), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
