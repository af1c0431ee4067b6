"""A model process on a memory bus."""

import numpy as np

from protocol import queries
from protocol.messages import Pose
from protocol.queries import AddDemonstration
from services.bus.arrays import motion_from_wire, motion_to_wire
from services.bus.memory import MemoryNetwork
from services.model.service import build
from services.process.clock import ManualClock
from services.process.config import Configuration, ModelSection, RobotSection

START = Pose((0.5, 0.0, 0.4), (1.0, 0.0, 0.0, 0.0))
OBJECT = (0.85, 0.05, 0.55)


class Rig:
    """A model process on a memory bus."""

    def __init__(self, path, kind="adaptive", scene="dishwasher"):
        self.clock = ManualClock()
        self.network = MemoryNetwork(self.clock)
        self.configuration = Configuration(
            robot=RobotSection(scene=scene), model=ModelSection(kind=kind, database=str(path))
        )
        self.service = build(self.network.bus(), self.clock, self.configuration)
        self.asker = self.network.bus()

    def ask(self, query, request):
        pending = self.asker.ask(query, request)
        self.service.step(self.clock.now_ns())
        return pending.poll()

    def teach(self, purpose, bend=0.0, at=OBJECT, duration=10.0, start=START.position, **more):
        t = np.linspace(0.0, 1.0, 40)[:, None]
        path = np.array(start) + t * np.subtract(at, start) + np.sin(np.pi * t) * [0.0, 0.0, bend]
        motion = motion_to_wire(path, np.tile(START.orientation, (40, 1)), duration)
        given = {"scene": "dishwasher", **more}
        return self.ask(queries.ADD_DEMONSTRATION, AddDemonstration(purpose, motion, at, **given))

    def described(self):
        return self.ask(queries.DESCRIBE, queries.Describe()).state

    def predict(self, at=OBJECT):
        return self.ask(queries.PREDICT, queries.Predict(at, START))


def positions(predicted):
    return motion_from_wire(predicted.prediction.motion)[0]
